// A triangle as a rasteriser may draw it: which texels it surely covers, and which it may.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "common/truth/cone_subtraction.h"

namespace penumbra::stress {

enum class Cover { no, maybe, yes };

/// How far a corner may be drawn beside its place.
struct DrawnOff {
    double snap = 0.0;         ///< texels by which the rasteriser moves it, along each axis
    glm::dvec3 rounding{0.0};  ///< of s and t, of r, and of q, before the division
    double nearest = 1.0;      ///< smallest q that is drawn: what is nearer is cut off
};

/// In homogeneous coordinates, so that corners may lie behind the eye (Olano & Greer 1997, "Triangle scan
/// conversion using 2D homogeneous coordinates").
class ProjectedTriangle {
 public:
    /// `textureFromWorld` makes (s q, t q, r q, q); a texture is `size` texels.
    ProjectedTriangle(const glm::dmat4& textureFromWorld, const glm::dvec2& size, const Triangle& triangle,
                      const DrawnOff& off);

    /// Is the point `at` (texels) inside, or outside, by more than its corners may be off?
    Cover covers(const glm::dvec2& at) const;
    /// r of its plane at `at`, q there, and by how much r changes for a texel along s and t.
    double depth(const glm::dvec2& at) const { return glm::dot(depth_, glm::dvec3(at, 1.0)) / volume_; }
    double distance(const glm::dvec2& at) const;
    glm::dvec2 slope() const { return glm::dvec2(depth_) / volume_; }
    /// Texels by which an edge may be drawn beside its place.
    double margin() const { return margin_; }
    /// Smallest and largest r of a corner; infinite where one is cut off.
    double least() const { return least_; }
    double most() const { return most_; }
    /// Longest edge over the smallest height, as drawn: what a plane's equation multiplies rounding by.
    double slenderness() const { return slenderness_; }

 private:
    std::array<glm::dvec3, 3> lines_{}, edges_{};
    glm::dvec3 depth_{0.0};
    double volume_ = 0.0, margin_ = 0.0, least_ = 0.0, most_ = 0.0, slenderness_ = 0.0;
    bool isLine_ = false;
};

}  // namespace penumbra::stress
