#include "common/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace penumbra {
namespace {

constexpr double worstPossible = 1e30;
constexpr std::size_t worstKept = 10;

bool counted(const FloatImage& mask, int x, int y) {
    return mask.values.empty() || mask.at(x, y) != 0.0f;
}

/// actual - exact; a value that is not finite (on either side) can never pass a bound.
double difference(float actual, float exact) {
    const double d = double(actual) - double(exact);
    return std::isfinite(d) ? d : worstPossible;
}

void requireComparable(const FloatImage& actual, const FloatImage& exact, const FloatImage& mask) {
    if (!actual.sameSizeAs(exact) || actual.channels != exact.channels)
        throw Error(fmt::format(
            "cannot compare a {}x{} picture of {} channels with one of {}x{} and {} channels", actual.width,
            actual.height, actual.channels, exact.width, exact.height, exact.channels));
    if (!mask.values.empty() && (!mask.sameSizeAs(actual) || mask.channels != 1))
        throw Error(fmt::format("the mask of a comparison is {}x{} with {} channels, the pictures are {}x{}",
                                mask.width, mask.height, mask.channels, actual.width, actual.height));
}

struct Candidate {
    double error;
    WorstPixel pixel;
};

/// Keeps the `worstKept` largest errors, largest first; of equal ones the first in reading order.
void keepWorst(std::vector<Candidate>& worst, const Candidate& candidate) {
    if (candidate.error <= 0.0) return;
    if (worst.size() == worstKept && candidate.error <= worst.back().error) return;
    const auto place =
        std::upper_bound(worst.begin(), worst.end(), candidate,
                         [](const Candidate& a, const Candidate& b) { return a.error > b.error; });
    worst.insert(place, candidate);
    if (worst.size() > worstKept) worst.pop_back();
}

struct Sums {
    double squares = 0.0;
    double absolute = 0.0;
    double plain = 0.0;
};

/// Adds the channels of one pixel to the sums; returns the channel that differs most.
Candidate addPixel(const FloatImage& actual, const FloatImage& exact, int x, int y, Sums& sums) {
    Candidate most{-1.0, {}};
    for (int c = 0; c < actual.channels; ++c) {
        const double d = difference(actual.at(x, y, c), exact.at(x, y, c));
        sums.squares += d * d;
        sums.absolute += std::abs(d);
        sums.plain += d;
        if (std::abs(d) > most.error) most = {std::abs(d), {x, y, actual.at(x, y, c), exact.at(x, y, c)}};
    }
    return most;
}

}  // namespace

ImageError compareImages(const FloatImage& actual, const FloatImage& exact, const FloatImage& mask) {
    requireComparable(actual, exact, mask);
    ImageError error;
    Sums sums;
    std::vector<Candidate> worst;
    for (int y = 0; y < actual.height; ++y) {
        for (int x = 0; x < actual.width; ++x) {
            if (!counted(mask, x, y)) {
                ++error.excluded;
                continue;
            }
            ++error.pixels;
            const Candidate most = addPixel(actual, exact, x, y, sums);
            error.maxAbs = std::max(error.maxAbs, most.error);
            keepWorst(worst, most);
        }
    }
    if (error.pixels == 0)
        throw Error(
            fmt::format("nothing to compare: the mask leaves out all {} pixels, so no error can be given",
                        error.excluded));
    const double count = double(error.pixels) * actual.channels;
    error.rmse = std::sqrt(sums.squares / count);
    error.meanAbs = sums.absolute / count;
    error.bias = sums.plain / count;
    for (const Candidate& candidate : worst) error.worst.push_back(candidate.pixel);
    return error;
}

FloatImage errorImage(const FloatImage& actual, const FloatImage& exact, const FloatImage& mask, float gain) {
    requireComparable(actual, exact, mask);
    FloatImage result(actual.width, actual.height, 3);
    for (int y = 0; y < actual.height; ++y) {
        for (int x = 0; x < actual.width; ++x) {
            const bool inside = counted(mask, x, y);
            for (int c = 0; c < 3; ++c) {
                const int source = std::min(c, actual.channels - 1);
                const double d = difference(actual.at(x, y, source), exact.at(x, y, source));
                result.at(x, y, c) = inside ? float(std::abs(d) * gain) : (c == 2 ? 0.25f : 0.0f);
            }
        }
    }
    return result;
}

}  // namespace penumbra
