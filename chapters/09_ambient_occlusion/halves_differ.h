// How sure is a picture that was made of two independent halves?
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numeric>
#include <vector>

namespace penumbra {

/// Sums of the squared differences of the two halves of each pixel, row by row: rows are worked on side by
/// side, and a sum of doubles in another order is another sum.
class HalvesDiffer {
 public:
    explicit HalvesDiffer(int rows) : squares_(std::size_t(rows), 0.0), values_(std::size_t(rows), 0.0) {}

    /// Of a pixel with so many channels. May run on many threads, each with rows of its own.
    void add(int row, const glm::dvec3& difference, int channels) {
        for (int c = 0; c < channels; ++c) squares_[std::size_t(row)] += difference[c] * difference[c];
        values_[std::size_t(row)] += channels;
    }
    /// Of a channel of the mean of both halves: half of what they differ by.
    double standardError() const {
        const double values = std::accumulate(values_.begin(), values_.end(), 0.0);
        const double squares = std::accumulate(squares_.begin(), squares_.end(), 0.0);
        return values > 0.0 ? 0.5 * std::sqrt(squares / values) : 0.0;
    }

 private:
    std::vector<double> squares_, values_;  ///< of each row
};

}  // namespace penumbra
