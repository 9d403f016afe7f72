// One light as the points of one plane see it.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "common/scene/scene.h"
#include "common/truth/cone_subtraction.h"

namespace penumbra {

/// Irradiance at points of a receiver's plane for a light of emission 1: area light, pi times the form
/// factor.
class PlaneLight {
 public:
    /// Keeps a reference to `light`.
    PlaneLight(const Receiver& receiver, const Light& light);

    /// Nothing in between: Lambert's formula.
    double unoccluded(const glm::dvec3& x) const;
    /// Behind triangles: cone subtraction; a segment for lights without an area.
    double visible(const glm::dvec3& x, std::span<const Triangle> occluders) const;

 private:
    double whole(const glm::dvec3& x, const std::vector<glm::dvec3>& polygon) const;
    double fromPoint(const glm::dvec3& x) const;
    bool seen(const glm::dvec3& x, std::span<const Triangle> occluders) const;

    glm::dvec3 n_;
    const Light& light_;
    Light unit_;            ///< a light without an area, of emission 1
    double plainly_ = 0.0;  ///< metres: far more than rounding
    bool isAbove_ = true;   ///< plainly, all of the light
};

}  // namespace penumbra
