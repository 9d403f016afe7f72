// Does a segment cross a triangle, and by how much? With 64 bits, and none of the code under test.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "common/truth/cone_subtraction.h"
#include "common/truth/ray_tracer.h"

namespace penumbra::stress {

/// How a segment crosses a triangle, metres. Whoever moves it by less than these changes nothing.
struct CrossingMargin {
    double sideways = 0.0;  ///< of its line from the nearest edge; negative: it passes by
    double ends = 0.0;      ///< of the nearer end from the plane; negative: both are on one side
    /// Smallest height over longest edge: the plane is the less known the smaller it is.
    double height = 0.0;

    /// As it is; and as it is known when the corners are rounded.
    double exact() const { return sideways < ends ? sideways : ends; }
    double known() const { return sideways < height * ends ? sideways : height * ends; }
};
/// Minus infinity if the triangle has no area, or the segment is parallel to it.
CrossingMargin crossingMargin(const ShadowRay& ray, const Triangle& triangle);

/// Over all triangles but the ray's own, the largest of each: above 0 the ray is blocked.
struct BlockedBy {
    double exact = 0.0, known = 0.0;
};
BlockedBy blockedBy(const ShadowRay& ray, const std::vector<Triangle>& triangles);

/// Along the ray, in lengths of its direction, to the plane of `triangle`; infinity if it is parallel.
double alongTo(const Ray& ray, const Triangle& triangle);

/// How many times the closed surface of `triangles` winds around `p`: 0 outside, 1 inside if the faces look
/// outwards. (Van Oosterom & Strackee 1983, IEEE Trans. Biomed. Eng. 30(2).)
double windingNumber(const std::vector<Triangle>& triangles, const glm::dvec3& p);

}  // namespace penumbra::stress
