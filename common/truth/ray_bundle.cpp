#include "common/truth/ray_bundle.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <string>

#include "common/error.h"

namespace penumbra {

struct RayBundle::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::atomic<std::int64_t> bytes{0};

    ~State() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

namespace {

bool countMemory(void* counter, ssize_t bytes, bool) {
    static_cast<std::atomic<std::int64_t>*>(counter)->fetch_add(bytes, std::memory_order_relaxed);
    return true;
}

/// Embree keeps its own copy: it reads 16 bytes at a time, past the end of a tight array of vec3.
void attachTriangles(RTCDevice device, RTCScene scene, const Scene& triangles) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), triangles.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                            triangles.triangleCount());
    if (vertices && indices) {
        std::ranges::copy(triangles.positions, static_cast<glm::vec3*>(vertices));
        std::ranges::copy(triangles.indices, static_cast<std::uint32_t*>(indices));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
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
    state_->device = rtcNewDevice(nullptr);
    if (!state_->device)
        throw Error("Embree does not start (error " + std::to_string(rtcGetDeviceError(nullptr)) + ")");
    rtcSetDeviceMemoryMonitorFunction(state_->device, countMemory, &state_->bytes);
    state_->scene = rtcNewScene(state_->device);
    attachTriangles(state_->device, state_->scene, scene);
    rtcCommitScene(state_->scene);
    if (const RTCError error = rtcGetDeviceError(state_->device); error != RTC_ERROR_NONE)
        throw Error("Embree cannot build scene '" + scene.name + "' (" +
                    std::to_string(scene.triangleCount()) + " triangles): error " + std::to_string(error) +
                    "; is memory short?");
}

RayBundle::~RayBundle() = default;

void RayBundle::blocked(std::span<const BundleRay> rays, float range, std::span<std::uint8_t> blocked) const {
    alignas(32) RTCRay8 packet;
    alignas(32) int valid[together];
    for (std::size_t first = 0; first < rays.size(); first += together) {
        const std::size_t count = std::min(together, rays.size() - first);
        pack(rays.data() + first, count, range, packet, valid);
        trace(valid, state_->scene, packet);
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
    rtcIntersect1(state_->scene, &found);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->scene, &context, &found);
#endif
    return found.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                       : found.ray.tfar;
}

std::size_t RayBundle::bytes() const {
    return std::size_t(std::max<std::int64_t>(0, state_->bytes.load()));
}

}  // namespace penumbra
