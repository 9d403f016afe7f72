// Rays per second of the reference ray tracer, and of bare Embree occlusion loops over the same rays in the
// same run, one ray at a time and in packets of 4, 8 and 16: the first must reach 80 % of the fastest of the
// others, for one lamp and for 64 points of an area light. One thread each. The last lines say whether it
// does:
//   build/release/bin/ray_tracer_bench --benchmark_enable_random_interleaving=true --benchmark_min_time=0.1
//       --benchmark_repetitions=7
#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <type_traits>

#include "common/math/sampling.h"
#include "common/truth/truth_image.h"
#include "tests/unit/embree_triangles.h"
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

#if RTC_VERSION_MAJOR >= 4
using How = RTCOccludedArguments;
How coherent() {
    How how;
    rtcInitOccludedArguments(&how);
    how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    return how;
}
void trace(const int*, RTCScene scene, RTCRay& ray, How& how) {
    rtcOccluded1(scene, &ray, &how);
}
void trace(const int* valid, RTCScene scene, RTCRay4& rays, How& how) {
    rtcOccluded4(valid, scene, &rays, &how);
}
void trace(const int* valid, RTCScene scene, RTCRay8& rays, How& how) {
    rtcOccluded8(valid, scene, &rays, &how);
}
void trace(const int* valid, RTCScene scene, RTCRay16& rays, How& how) {
    rtcOccluded16(valid, scene, &rays, &how);
}
#else
using How = RTCIntersectContext;
How coherent() {
    How how;
    rtcInitIntersectContext(&how);
    how.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return how;
}
void trace(const int*, RTCScene scene, RTCRay& ray, How& how) {
    rtcOccluded1(scene, &how, &ray);
}
void trace(const int* valid, RTCScene scene, RTCRay4& rays, How& how) {
    rtcOccluded4(valid, scene, &how, &rays);
}
void trace(const int* valid, RTCScene scene, RTCRay8& rays, How& how) {
    rtcOccluded8(valid, scene, &how, &rays);
}
void trace(const int* valid, RTCScene scene, RTCRay16& rays, How& how) {
    rtcOccluded16(valid, scene, &how, &rays);
}
#endif

/// Field `i` of a packet's row, and of a single ray, whose rows are plain numbers.
template <class Row>
auto& lane(Row& row, std::size_t i) {
    if constexpr (std::is_array_v<Row>)
        return row[i];
    else
        return row;
}

/// `width` rays of `Rays` at a time.
template <class Rays, std::size_t width>
void bareLoop(benchmark::State& state) {
    // The same triangles and flags, a constant offset against self-shadowing, no filter.
    static const EmbreeTriangles bare(subject().scene);
    const std::vector<ShadowRay> rays = shadowRays(int(state.range(0)));
    std::vector<std::uint8_t> blocked(rays.size());
    for (auto _ : state) {
        for (std::size_t first = 0; first < rays.size(); first += width) {
            alignas(64) int valid[width] = {};
            alignas(64) Rays packet;
            const std::size_t count = std::min(width, rays.size() - first);
            for (std::size_t i = 0; i < count; ++i) {
                const ShadowRay& ray = rays[first + i];
                const glm::vec3 o(ray.origin), d(ray.target - ray.origin);
                lane(packet.org_x, i) = o.x, lane(packet.org_y, i) = o.y, lane(packet.org_z, i) = o.z;
                lane(packet.dir_x, i) = d.x, lane(packet.dir_y, i) = d.y, lane(packet.dir_z, i) = d.z;
                lane(packet.tnear, i) = 1e-4f, lane(packet.tfar, i) = 0.9999f, lane(packet.time, i) = 0.0f;
                lane(packet.mask, i) = 0xffffffffu, lane(packet.id, i) = unsigned(i);
                lane(packet.flags, i) = 0;
                valid[i] = -1;
            }
            How how = coherent();
            trace(valid, bare.scene(), packet, how);
            for (std::size_t i = 0; i < count; ++i) blocked[first + i] = lane(packet.tfar, i) < 0.0f;
        }
        benchmark::DoNotOptimize(blocked.data());
    }
    reportRate(state, rays.size());
}

void bareOne(benchmark::State& state) {
    bareLoop<RTCRay, 1>(state);
}
void bareFour(benchmark::State& state) {
    bareLoop<RTCRay4, 4>(state);
}
void bareEight(benchmark::State& state) {
    bareLoop<RTCRay8, 8>(state);
}
void bareSixteen(benchmark::State& state) {
    bareLoop<RTCRay16, 16>(state);
}

constexpr int lamp = 1, areaLight = 64;  // rays a point
BENCHMARK(bareOne)->Arg(lamp)->Arg(areaLight)->Unit(benchmark::kMillisecond);
BENCHMARK(bareFour)->Arg(lamp)->Arg(areaLight)->Unit(benchmark::kMillisecond);
BENCHMARK(bareEight)->Arg(lamp)->Arg(areaLight)->Unit(benchmark::kMillisecond);
BENCHMARK(bareSixteen)->Arg(lamp)->Arg(areaLight)->Unit(benchmark::kMillisecond);
BENCHMARK(tracedByUs)->Arg(lamp)->Arg(areaLight)->Unit(benchmark::kMillisecond);

/// Prints as usual, and remembers the times.
class Judge : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs)
            if (run.run_type == Run::RT_Iteration)
                seconds_[run.run_name.args][run.run_name.function_name].push_back(run.GetAdjustedCPUTime());
    }

    /// One line for each number of rays a point: us against the fastest bare loop, by the medians.
    void judge() {
        for (auto& [rays, loops] : seconds_) {
            std::string fastest;
            double least = std::numeric_limits<double>::infinity(), ours = 0.0;
            for (auto& [name, times] : loops) {
                const double time = median(times);
                if (name == "tracedByUs") {
                    ours = time;
                } else if (time < least) {
                    least = time;
                    fastest = name;
                }
            }
            if (ours > 0.0 && !fastest.empty())
                fmt::print(
                    "{} rays a point: {:.1f} % of the fastest bare loop, {} (at least 80 % is asked for)\n",
                    rays, 100.0 * least / ours, fastest);
        }
    }

 private:
    static double median(std::vector<double>& times) {
        const auto middle = times.begin() + long(times.size() / 2);
        std::nth_element(times.begin(), middle, times.end());
        return *middle;
    }

    std::map<std::string, std::map<std::string, std::vector<double>>> seconds_;
};

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    penumbra::Judge judge;
    benchmark::RunSpecifiedBenchmarks(&judge);
    judge.judge();
}
