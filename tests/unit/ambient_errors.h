// Errors of an estimator of ambient visibility and bent vector in a situation whose exact answer is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "common/math/sampling.h"
#include "tests/unit/ambient_quadrature.h"
#include "tests/unit/ambient_situations.h"

namespace penumbra {

inline constexpr int turns = 20, seedsPerTurn = 12, trials = turns * seedsPerTurn;

/// Sums over trials of the differences from the exact answer, in the frame of the point.
struct Errors {
    double sum = 0.0, squares = 0.0, angles = 0.0;
    glm::dvec3 bent{0.0}, bentSquares{0.0};

    void add(const AmbientValue& value, double visibility, const glm::dvec3& bentVector) {
        const double error = value.visibility - visibility;
        const glm::dvec3 bentError = value.bent - bentVector;
        sum += error;
        squares += error * error;
        bent += bentError;
        bentSquares += bentError * bentError;
        const double angle =
            std::atan2(glm::length(glm::cross(value.bent, bentVector)), glm::dot(value.bent, bentVector));
        angles += angle * angle;
    }
    double rmse() const { return std::sqrt(squares / trials); }
    double bias() const { return sum / trials; }
    double standardError() const { return std::sqrt(squares) / trials; }
    glm::dvec3 bentBias() const { return bent / double(trials); }
    glm::dvec3 bentStandardError() const { return glm::sqrt(bentSquares) / double(trials); }
    double rmsDegrees() const { return std::sqrt(angles / trials) * 180.0 / std::numbers::pi; }
};

inline glm::dmat3 tilted(const glm::dmat3& frame, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return frame * glm::dmat3(glm::dvec3(c, 0, -s), glm::dvec3(0, 1, 0), glm::dvec3(s, 0, c));
}

using Estimator = std::function<AmbientValue(const RayTracer&, const Hit&, const glm::dvec3&,
                                             const AmbientRays&, std::uint32_t, std::int64_t&)>;

struct Measured {
    std::vector<Errors> errors;  ///< for each number of rays
    double built = 0.0;          ///< how far the scenes were off from the closed form: see Situation::built
};

/// With each number of rays, over `trials` turns of the scene and seeds.
inline Measured errorsOf(const Situation& situation, Weighting weighting, std::span<const int> rayCounts,
                         const Estimator& estimate) {
    std::mt19937_64 random(7);
    Measured measured{std::vector<Errors>(rayCounts.size())};
    for (int turn = 0; turn < turns; ++turn) {
        AmbientScene scene(turned(turn, turns, random));
        situation.build(scene);
        const bool closedForm = situation.tilt != 0.0 || std::isfinite(situation.reach.range);
        const AmbientForm exact = closedForm ? situation.form : scene.exact();
        measured.built = std::max(measured.built, difference(exact, situation.form));
        const bool cosine = weighting == Weighting::cosine;
        const RayTracer tracer(scene.scene());
        const glm::dmat3 worldFromPoint = tilted(scene.worldFromPoint(), situation.tilt);
        for (std::size_t k = 0; k < rayCounts.size(); ++k)
            for (std::uint32_t i = 0; i < seedsPerTurn; ++i) {
                std::int64_t traced = 0;
                AmbientValue value = estimate(
                    tracer, scene.point(), worldFromPoint[2], {rayCounts[k], weighting, situation.reach},
                    hashSeed(std::uint32_t(turn), i, std::uint32_t(2 * k + cosine)), traced);
                value.bent = glm::transpose(worldFromPoint) * value.bent;
                measured.errors[k].add(value, cosine ? exact.cosine : exact.uniform,
                                       cosine ? exact.cosineBent : exact.uniformBent);
            }
    }
    return measured;
}

}  // namespace penumbra
