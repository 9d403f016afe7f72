#include "common/truth/embree_hierarchy.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <string>

#include "common/error.h"

namespace penumbra {

EmbreeHierarchy::EmbreeHierarchy() : device_(rtcNewDevice(nullptr)) {
    if (!device_)
        throw Error("Embree does not start (error " + std::to_string(rtcGetDeviceError(nullptr)) + ")");
    scene_ = rtcNewScene(device_);
}

EmbreeHierarchy::~EmbreeHierarchy() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void EmbreeHierarchy::add(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                          const Prepare& prepare) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree keeps its own copy: it reads 16 bytes at a time, past the end of a tight array of vec3.
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), positions.size());
    void* corners =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, indices.size() / 3);
    if (vertices && corners) {
        std::ranges::copy(positions, static_cast<glm::vec3*>(vertices));
        std::ranges::copy(indices, static_cast<std::uint32_t*>(corners));
        if (prepare) prepare(geometry);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
    }
    rtcReleaseGeometry(geometry);
}

void EmbreeHierarchy::build(const Scene& scene) {
    rtcCommitScene(scene_);
    if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE)
        throw Error("Embree cannot build scene '" + scene.name + "' (" +
                    std::to_string(scene.triangleCount()) + " triangles): error " + std::to_string(error) +
                    "; is memory short?");
}

}  // namespace penumbra
