// Embree's copy of a scene's triangles, built: what its users share.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>

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

    using Prepare = std::function<void(RTCGeometryTy*)>;
    /// Copies triangles. `prepare` may give the geometry filters.
    void add(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
             const Prepare& prepare = {});
    /// Builds, as device() and scene() were told to; once. Throws Error if memory is short; `source` is
    /// named.
    void build(const Scene& source);

    RTCDeviceTy* device() const { return device_; }
    RTCSceneTy* scene() const { return scene_; }

 private:
    RTCDeviceTy* device_;
    RTCSceneTy* scene_;
};

}  // namespace penumbra
