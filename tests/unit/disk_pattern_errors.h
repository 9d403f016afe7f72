// The error of a filter with a pattern of its own for every random edge: of the tests and of the benchmark.
#pragma once

#include <cmath>
#include <numbers>

#include "chapters/05_jittered_disk/disk_pattern.h"
#include "common/math/sampling.h"
#include "common/truth/edge_coverage.h"

namespace penumbra {

/// A random straight edge through the unit disk, in any direction.
struct RandomEdge {
    explicit RandomEdge(std::uint32_t trial) {
        const double angle = 2.0 * std::numbers::pi * hashSeed(trial, 0, 77) * 0x1p-32;
        normal = {std::cos(angle), std::sin(angle)};
        distance = 2.0 * hashSeed(trial, 1, 77) * 0x1p-32 - 1.0;
    }
    glm::dvec2 normal{0.0};
    double distance = 0.0;
};

struct PatternErrors {
    double rms = 0.0;
    double mean = 0.0;  ///< of the error towards the nearer side: over all edges left and right would cancel
};

/// Lit share minus the disk's exact coverage, over `trials` edges.
inline PatternErrors patternErrors(SquarePattern pattern, DiskMap map, int count, int trials) {
    PatternErrors e;
    for (std::uint32_t trial = 0; trial < std::uint32_t(trials); ++trial) {
        const auto points = diskPattern(pattern, map, count, hashSeed(trial, 5));
        const RandomEdge edge(trial);
        const double error = litShare(points, edge.normal, edge.distance) - diskCoverage(edge.distance, 1.0);
        e.rms += error * error / trials;
        e.mean += (edge.distance < 0.0 ? -error : error) / trials;
    }
    e.rms = std::sqrt(e.rms);
    return e;
}

}  // namespace penumbra
