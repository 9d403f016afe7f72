// What unit tests expect of the errors of an ambient estimator.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "tests/unit/ambient_errors.h"

namespace penumbra {

/// errorsOf; fails if the scene is not what it should be.
inline std::vector<Errors> expectErrors(const Situation& situation, Weighting weighting,
                                        std::span<const int> rayCounts, const Estimator& estimate) {
    const Measured measured = errorsOf(situation, weighting, rayCounts, estimate);
    EXPECT_LE(measured.built, situation.built) << "the scene is not what it should be";
    return measured.errors;
}

/// A: to within so many standard errors. Each axis of the bent vector: to within 4.
inline void expectUnbiased(const Errors& errors, double standardErrors, double rounding) {
    EXPECT_LE(std::abs(errors.bias()), standardErrors * errors.standardError() + rounding);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_LE(std::abs(errors.bentBias()[axis]), 4.0 * errors.bentStandardError()[axis] + rounding)
            << "axis " << axis;
}

}  // namespace penumbra
