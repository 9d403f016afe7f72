// Where a case puts its scene: turned, scaled, far from the origin of its file.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "common/scene/scene.h"
#include "common/truth/cone_subtraction.h"
#include "tests/stress/case.h"
#include "tests/stress/dice.h"

namespace penumbra::stress {

inline constexpr double radians = 0.017453292519943295;  ///< in a degree

/// From the coordinates in which a subject thinks (about a metre in size, around the origin) to those of a
/// loaded scene: through the coordinates of a file in double, as the loader goes, whose origin is then
/// subtracted.
class Placement {
 public:
    /// Axes scale, distance and aside; `dice` turns. `eye`: of the camera, which the loader puts the origin
    /// near.
    Placement(const Case& given, const glm::dvec3& eye, Dice& dice);

    glm::dvec3 point(const glm::dvec3& p) const;
    glm::dvec3 direction(const glm::dvec3& d) const { return turn_ * d; }
    double length(double metres) const { return scale_ * metres; }
    std::vector<Triangle> triangles(std::vector<Triangle> local) const;
    /// What a coordinate of the loaded scene may be off by, metres: rounding to double in the file, to float
    /// here.
    double rounding(const Scene& scene) const;

 private:
    glm::dvec3 inFile(const glm::dvec3& p) const { return offset_ + scale_ * (turn_ * p); }

    double scale_;
    glm::dmat3 turn_{1.0};
    glm::dvec3 offset_{0.0}, origin_{0.0};
};

/// Is the scene near enough to the origin of its floats for what is promised? The loader puts that near the
/// first camera, so a scene is aside only as far as the camera is away: from a thousand times its size it is
/// three pixels of 64 even through one degree. Beyond, float positions are coarser than the steps between
/// pixels from which slopes and normals are taken (about 2^24 steps away); how wrong that gets is measured,
/// and fails nothing.
inline bool promised(const Case& given) {
    return given.number("aside") <= 1e3;
}

/// Triangles with what drawing needs besides: one cluster, and a material that is lit on both sides.
Scene drawnScene(const std::vector<Triangle>& triangles);

/// A camera at `eye` that looks at `target`, `fov` radians high.
Camera cameraOf(const Placement& placement, const glm::dvec3& eye, const glm::dvec3& target, double fov);

/// The light of the axis light-type (directional where the subject has none), `toLight` from `target`,
/// `distance` away; a spot is as wide as `halfAngle`.
Light lightOf(const Case& given, const Placement& placement, const glm::dvec3& target,
              const glm::dvec3& toLight, double distance, double halfAngle);

}  // namespace penumbra::stress
