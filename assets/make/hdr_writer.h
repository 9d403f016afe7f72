// Writes latitude-longitude pictures of radiance as Radiance .hdr files, the same bytes each time.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>

namespace penumbra::assets {

/// A picture of everything around, Y up: the top row looks up, the middle column along -z, and columns grow
/// towards +x.
struct Environment {
    int width = 0;
    int height = 0;
    /// Radiance from a unit direction; averaged over 4 x 4 points of each texel.
    std::function<glm::dvec3(const glm::dvec3& direction)> radiance;
};

/// Shared exponent, eight bits for each channel (Ward, "Real Pixels", 1991, Graphics Gems II), run-length
/// encoded. Throws Error when the file cannot be written.
void writeHdr(const std::filesystem::path& file, const Environment& environment);

/// 0 below `low`, 1 above `high`, smooth between.
double smoothStep(double low, double high, double x);

}  // namespace penumbra::assets
