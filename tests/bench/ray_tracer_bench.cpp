// Rays per second of the reference ray tracer, and of a bare Embree occlusion loop over the same rays in the
// same run: the first must reach 80 % of the second. One thread each.
#include <benchmark/benchmark.h>
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <random>

#include "common/math/sampling.h"
#include "common/truth/truth_image.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {
namespace {

/// A wavy ground of 80 000 triangles under a lamp or a square light, seen from above.
struct Subject {
    Scene scene = test_meshes::emptyScene();
    std::unique_ptr<RayTracer> tracer;
    std::vector<Hit> hits;

    Subject() {
        test_meshes::addTerrain(scene, 200, 0.08, test_meshes::scaledAndMoved(4.0, 0.0));
        tracer = std::make_unique<RayTracer>(scene);
        Camera camera;
        camera.position = {0, 4, 5};
        camera.forward = glm::normalize(glm::dvec3(0, -4, -5));
        camera.up = glm::normalize(glm::dvec3(0, 5, -4));
        for (const Hit& hit : primaryHits(*tracer, camera, {256, 256}).hits)
            if (hit.valid) hits.push_back(hit);
    }
};

Subject& subject() {
    static Subject made;
    return made;
}

/// `perPoint` 1: one lamp, neighbouring pixels side by side. More: so many points of a square light for each
/// pixel.
std::vector<ShadowRay> shadowRays(int perPoint) {
    std::vector<ShadowRay> rays;
    std::uint32_t pixel = 0;
    for (const Hit& hit : subject().hits) {
        ++pixel;
        if (perPoint > 1 && pixel % std::uint32_t(perPoint) != 0) continue;
        for (int i = 0; i < perPoint; ++i) {
            const glm::dvec2 u = perPoint > 1 ? owenSobol(std::uint32_t(i), pixel) - 0.5 : glm::dvec2(0.0);
            rays.push_back(ShadowRay::from(hit, {3.0 + u.x, 1.5, u.y}));
        }
    }
    return rays;
}

void reportRate(benchmark::State& state, std::size_t rays) {
    state.counters["rays_per_second"] =
        benchmark::Counter(double(rays), benchmark::Counter::kIsIterationInvariantRate);
}

void tracedByUs(benchmark::State& state) {
    const std::vector<ShadowRay> rays = shadowRays(int(state.range(0)));
    std::vector<std::uint8_t> blocked(rays.size());
    subject().tracer->occluded(rays, blocked);
    for (auto _ : state) {
        subject().tracer->occluded(rays, blocked);
        benchmark::DoNotOptimize(blocked.data());
    }
    state.counters["blocked"] = double(std::count(blocked.begin(), blocked.end(), 1)) / double(rays.size());
    reportRate(state, rays.size());
}

/// Nothing but Embree: same triangles, same flags, a constant offset against self-shadowing, no filter.
struct Bare {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    explicit Bare(const Scene& s) {
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::copy(s.positions.begin(), s.positions.end(),
                  static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
                      g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, s.positions.size())));
        std::copy(s.indices.begin(), s.indices.end(),
                  static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
                      g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, s.triangleCount())));
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene, g);
        rtcReleaseGeometry(g);
        rtcCommitScene(scene);
    }
};

void bareLoop(benchmark::State& state) {
    static const Bare bare(subject().scene);
    const std::vector<ShadowRay> rays = shadowRays(int(state.range(0)));
    std::vector<std::uint8_t> blocked(rays.size());
    for (auto _ : state) {
        for (std::size_t first = 0; first < rays.size(); first += 16) {
            alignas(64) int valid[16] = {};
            alignas(64) RTCRay16 packet;
            const std::size_t count = std::min<std::size_t>(16, rays.size() - first);
            for (std::size_t i = 0; i < count; ++i) {
                const ShadowRay& ray = rays[first + i];
                const glm::vec3 o(ray.origin), d(ray.target - ray.origin);
                packet.org_x[i] = o.x, packet.org_y[i] = o.y, packet.org_z[i] = o.z;
                packet.dir_x[i] = d.x, packet.dir_y[i] = d.y, packet.dir_z[i] = d.z;
                packet.tnear[i] = 1e-4f, packet.tfar[i] = 0.9999f, packet.time[i] = 0.0f;
                packet.mask[i] = 0xffffffffu, packet.id[i] = unsigned(i), packet.flags[i] = 0;
                valid[i] = -1;
            }
#if RTC_VERSION_MAJOR >= 4
            RTCOccludedArguments arguments;
            rtcInitOccludedArguments(&arguments);
            arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
            rtcOccluded16(valid, bare.scene, &packet, &arguments);
#else
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            rtcOccluded16(valid, bare.scene, &context, &packet);
#endif
            for (std::size_t i = 0; i < count; ++i) blocked[first + i] = packet.tfar[i] < 0.0f;
        }
        benchmark::DoNotOptimize(blocked.data());
    }
    reportRate(state, rays.size());
}

BENCHMARK(bareLoop)->Arg(1)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(tracedByUs)->Arg(1)->Arg(64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace penumbra

BENCHMARK_MAIN();
