// Embree's copy of a scene's triangles, built: what its users share.
#pragma once

#include "common/scene/scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;

namespace penumbra {

class EmbreeHierarchy {
 public:
    /// Starts Embree; the hierarchy is still empty. Throws Error if Embree does not start.
    EmbreeHierarchy();
    ~EmbreeHierarchy();
    EmbreeHierarchy(const EmbreeHierarchy&) = delete;
    EmbreeHierarchy& operator=(const EmbreeHierarchy&) = delete;

    /// Copies the triangles of `scene` and builds, as device() and scene() were told to; once. `prepare` may
    /// give the geometry filters. Throws Error if memory is short.
    void build(const Scene& scene, void (*prepare)(RTCGeometryTy*) = nullptr);

    RTCDeviceTy* device() const { return device_; }
    RTCSceneTy* scene() const { return scene_; }

 private:
    RTCDeviceTy* device_;
    RTCSceneTy* scene_;
};

}  // namespace penumbra
