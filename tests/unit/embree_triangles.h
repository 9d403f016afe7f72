// A scene's triangles in Embree alone (float), and nothing of ours besides.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>

#include "common/scene/scene.h"

namespace penumbra {

class EmbreeTriangles {
 public:
    /// By default as in RayTracer.
    explicit EmbreeTriangles(const Scene& s, RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST,
                             RTCBuildQuality quality = RTC_BUILD_QUALITY_HIGH) {
        rtcSetSceneFlags(scene_, flags);
        rtcSetSceneBuildQuality(scene_, quality);
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::copy(s.positions.begin(), s.positions.end(),
                  static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
                      g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, s.positions.size())));
        std::copy(s.indices.begin(), s.indices.end(),
                  static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
                      g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, s.triangleCount())));
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene_, g);
        rtcReleaseGeometry(g);
        rtcCommitScene(scene_);
    }
    ~EmbreeTriangles() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeTriangles(const EmbreeTriangles&) = delete;
    EmbreeTriangles& operator=(const EmbreeTriangles&) = delete;

    RTCScene scene() const { return scene_; }

 private:
    RTCDevice device_ = rtcNewDevice(nullptr);
    RTCScene scene_ = rtcNewScene(device_);
};

}  // namespace penumbra
