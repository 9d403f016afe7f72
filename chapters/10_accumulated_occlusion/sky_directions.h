// The directions that a shadow map is drawn from.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// "fibonacci", "owen-sobol", "random": the choices of --directions.
const std::vector<std::string>& directionPatternNames();

/// `count` (at least 1) unit vectors towards the sky, equally dense on the whole sphere: points share them,
/// and their normals look everywhere. `pattern`: one of directionPatternNames(), UsageError otherwise. `seed`
/// chooses the random part of owen-sobol and random; fibonacci has none.
std::vector<glm::dvec3> skyDirections(int count, const std::string& pattern, std::uint32_t seed);

/// Each of `count` directions stands for a part of the sphere as large as a cap of 4 pi / count. Tangent of
/// that cap's angular radius; at most 1/2: wider caps are no cones that a map could show.
double cellTangent(int count);

/// A random rotation, equally likely all (Shoemake, "Uniform Random Rotations", 1992, Graphics Gems III);
/// `index` 0: none, so that the first frame is the pattern itself.
glm::dmat3 skyRotation(std::uint32_t index, std::uint32_t seed);

}  // namespace penumbra
