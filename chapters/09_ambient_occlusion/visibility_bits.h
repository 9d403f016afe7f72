// Stored visibility S(x, l): one bit for each vertex and each of a fixed set of directions. What the sky
// looks like is decided afterwards, and no ray is traced again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "chapters/09_ambient_occlusion/sky.h"
#include "chapters/09_ambient_occlusion/vertex_bake.h"

namespace penumbra {

/// Bit l of point x: 1 if x sees the sky in direction l. Who fills it (rays here, shadow maps in chapter 10)
/// leaves directions below the horizon of x, n.l <= 0, at 0.
struct VisibilityBits {
    /// Unit; equal areas of the whole sphere, so that each stands for 4 pi / count steradians.
    std::vector<glm::vec3> directions;
    std::size_t points = 0;
    std::vector<std::uint64_t> words;  ///< wordsPerPoint() for each point; bit l % 64 of word l / 64

    /// All bits 0.
    static VisibilityBits allBlocked(std::vector<glm::vec3> directions, std::size_t points);

    std::size_t wordsPerPoint() const { return (directions.size() + 63) / 64; }
    bool open(std::size_t point, std::size_t l) const {
        return (words[point * wordsPerPoint() + l / 64] >> (l % 64) & 1u) != 0;
    }
    void setOpen(std::size_t point, std::size_t l) {
        words[point * wordsPerPoint() + l / 64] |= std::uint64_t(1) << (l % 64);
    }
    /// Memory, bytes.
    std::size_t bytes() const { return words.size() * sizeof(words[0]) + directions.size() * 12; }
};

/// `count` directions of the spherical Fibonacci lattice, in float.
std::vector<glm::vec3> skyDirections(int count);

struct BakedBits {
    VisibilityBits bits;
    BakeWork work;
};

/// Bits of every vertex of the scene by rays (point sampled), `directions` 64 to 1024. A non-empty
/// `partialFile` keeps what is finished for the next call with the same scene, directions and reach
/// (doAllPieces in work_in_pieces.h). `skip`: raysToOpenSky.
BakedBits bakeBits(const Scene& scene, const RayBundle& bundle, int directions, const AmbientReach& reach,
                   const std::filesystem::path& partialFile = {}, const ProgressCallback& progress = {},
                   bool skip = true);

/// Radiance of the sky in each direction, for `relight`. A part of the sky is switched off by setting its
/// entries to 0.
std::vector<glm::vec3> skyRadiance(const Sky& sky, std::span<const glm::vec3> directions);

/// The direction nearest to `toSun` (unit) as a light of irradiance `sun` (W/m^2 on a plane that faces it)
/// added to `radiance`: a sun with a hard shadow, as coarse as the set of directions.
void addSun(std::span<const glm::vec3> directions, const glm::dvec3& toSun, const glm::dvec3& sun,
            std::span<glm::vec3> radiance);

/// Irradiance at every point under `radiance` (one per direction, W / (m^2 sr)), exact for the bits:
/// E(x) = sum_l S(x, l) radiance_l max(0, n.l) 4 pi / count. `normals`: one per point, unit. On all cores.
std::vector<glm::vec3> relight(const VisibilityBits& bits, std::span<const glm::vec3> normals,
                               std::span<const glm::vec3> radiance);

/// Ambient visibility and bent vector of a point from its bits, with either weighting.
AmbientValue ambientFromBits(const VisibilityBits& bits, std::size_t point, const glm::dvec3& normal,
                             Weighting weighting);

}  // namespace penumbra
