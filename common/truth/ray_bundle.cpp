#include "common/truth/ray_bundle.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "common/truth/embree_hierarchy.h"
#include "common/truth/segment_test.h"
#include "common/truth/shadow_packet.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

struct RayBundle::State {
    std::atomic<std::int64_t> bytes{0};  // before the hierarchy, which counts down when it goes
    EmbreeHierarchy hierarchy;
    std::vector<std::array<glm::dvec3, 3>> slender;

    void add(const Scene& scene);
};

namespace {

/// Embree's float normal of a triangle of edge e and height h is off by 4.6 * 2^-24 e/h at most
/// (decisiveUlps), about a fifth of it as a rule: at the triangle's far end by half an ulp of the scene's
/// size L for every e^2 / (h L). A ray begins 16 ulps above its surface; where the plane may be off by half
/// as much, its sign is left to double.
bool isSlender(const std::array<glm::dvec3, 3>& t, double reach) {
    constexpr double most = 16.0;
    const double longest =
        std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
    const double twiceArea = glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    return longest * longest * longest > most * twiceArea * reach;
}

/// Is a slender triangle there in double?
void exactFilter(const RTCFilterFunctionNArguments* arguments) {
    const auto& slender =
        *static_cast<const std::vector<std::array<glm::dvec3, 3>>*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    RTCRayN* ray = arguments->ray;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const Segment segment{{RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i)},
                              {RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i)},
                              true};
        if (crossTriangle(segment, slender[RTCHitN_primID(arguments->hit, n, i)]) != Crossing::inside)
            arguments->valid[i] = 0;
    }
}

bool countMemory(void* counter, ssize_t bytes, bool) {
    static_cast<std::atomic<std::int64_t>*>(counter)->fetch_add(bytes, std::memory_order_relaxed);
    return true;
}

constexpr std::size_t together = 8;

/// `count` rays, the first `together` of `rays`, in Embree's layout.
void pack(const BundleRay* rays, std::size_t count, float range, RTCRay8& packet, int* valid) {
    for (std::size_t i = 0; i < together; ++i) {
        const BundleRay& ray = rays[i < count ? i : 0];
        packet.org_x[i] = ray.origin.x, packet.org_y[i] = ray.origin.y, packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x, packet.dir_y[i] = ray.direction.y;
        packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = 0.0f, packet.tfar[i] = range, packet.time[i] = 0.0f;
        packet.mask[i] = 0xffffffffu, packet.id[i] = 0, packet.flags[i] = 0;
        valid[i] = i < count ? -1 : 0;
    }
}

void trace(const int* valid, RTCScene scene, RTCRay8& packet) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded8(valid, scene, &packet);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded8(valid, scene, &context, &packet);
#endif
}

}  // namespace

/// Slender ones apart from the others, which then pay for no filter.
void RayBundle::State::add(const Scene& scene) {
    const double reach = largestCoordinate(scene.bounds);
    std::vector<std::uint32_t> ordinary, corners;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
        const std::array<glm::dvec3, 3> triangle = cornersOf(scene, t);
        const bool inDouble = isSlender(triangle, reach);
        const auto* indices = &scene.indices[3 * std::size_t(t)];
        if (inDouble) slender.push_back(triangle);
        std::vector<std::uint32_t>& list = inDouble ? corners : ordinary;
        list.insert(list.end(), indices, indices + 3);
    }
    hierarchy.add(scene.positions, ordinary);
    if (slender.empty()) return;
    hierarchy.add(scene.positions, corners, [this](RTCGeometry geometry) {
        rtcSetGeometryUserData(geometry, &slender);
        rtcSetGeometryOccludedFilterFunction(geometry, exactFilter);
        rtcSetGeometryIntersectFilterFunction(geometry, exactFilter);
    });
}

RayBundle::RayBundle(const Scene& scene) : state_(std::make_unique<State>()) {
    rtcSetDeviceMemoryMonitorFunction(state_->hierarchy.device(), countMemory, &state_->bytes);
    state_->add(scene);
    state_->hierarchy.build(scene);
}

RayBundle::~RayBundle() = default;

void RayBundle::blocked(std::span<const BundleRay> rays, float range, std::span<std::uint8_t> blocked) const {
    alignas(32) RTCRay8 packet;
    alignas(32) int valid[together];
    for (std::size_t first = 0; first < rays.size(); first += together) {
        const std::size_t count = std::min(together, rays.size() - first);
        pack(rays.data() + first, count, range, packet, valid);
        trace(valid, state_->hierarchy.scene(), packet);
        for (std::size_t i = 0; i < count; ++i) blocked[first + i] = packet.tfar[i] < 0.0f ? 1 : 0;
    }
}

float RayBundle::distance(const BundleRay& ray, float range) const {
    RTCRayHit found{};
    found.ray.org_x = ray.origin.x, found.ray.org_y = ray.origin.y, found.ray.org_z = ray.origin.z;
    found.ray.dir_x = ray.direction.x, found.ray.dir_y = ray.direction.y, found.ray.dir_z = ray.direction.z;
    found.ray.tfar = range;
    found.ray.mask = 0xffffffffu;
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(state_->hierarchy.scene(), &found);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->hierarchy.scene(), &context, &found);
#endif
    return found.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                       : found.ray.tfar;
}

std::size_t RayBundle::bytes() const {
    return std::size_t(std::max<std::int64_t>(0, state_->bytes.load()));
}

}  // namespace penumbra
