#include "common/truth/ray_bundle.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>

#include "common/truth/embree_hierarchy.h"

namespace penumbra {

struct RayBundle::State {
    std::atomic<std::int64_t> bytes{0};  // before the hierarchy, which counts down when it goes
    EmbreeHierarchy hierarchy;
};

namespace {

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

RayBundle::RayBundle(const Scene& scene) : state_(std::make_unique<State>()) {
    rtcSetDeviceMemoryMonitorFunction(state_->hierarchy.device(), countMemory, &state_->bytes);
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
        for (std::size_t i = 0; i < count; ++i) {
            const BundleRay& ray = rays[first + i];
            blocked[first + i] = packet.tfar[i] < 0.0f ? 1 : 0;
            if (blocked[first + i] && ray.besides != BundleRay::noTriangle)
                blocked[first + i] = std::isfinite(distance(ray, range)) ? 1 : 0;
        }
    }
}

namespace {

void intersect(RTCScene scene, RTCRayHit& found) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &found);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &found);
#endif
}

}  // namespace

float RayBundle::distance(const BundleRay& ray, float range) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    RTCRayHit found{};
    found.ray.org_x = ray.origin.x, found.ray.org_y = ray.origin.y, found.ray.org_z = ray.origin.z;
    found.ray.dir_x = ray.direction.x, found.ray.dir_y = ray.direction.y, found.ray.dir_z = ray.direction.z;
    found.ray.mask = 0xffffffffu;
    do {
        found.ray.tfar = range;
        found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        intersect(state_->hierarchy.scene(), found);
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return infinity;
        // Met where it is not: on with what is behind.
        found.ray.tnear = std::nextafter(found.ray.tfar, infinity);
    } while (found.hit.primID == ray.besides && found.ray.tnear < range);
    return found.hit.primID == ray.besides ? infinity : found.ray.tfar;
}

std::size_t RayBundle::bytes() const {
    return std::size_t(std::max<std::int64_t>(0, state_->bytes.load()));
}

}  // namespace penumbra
