// Random numbers that are the same with every compiler (std::uniform_real_distribution is not).
#pragma once

#include <cstdint>

namespace penumbra::assets {

/// PCG-XSH-RR 32 (O'Neill, 2014).
class Random {
 public:
    explicit Random(std::uint64_t seed) : state_(seed * 6364136223846793005u + 1442695040888963407u) {
        next();
    }

    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005u + 1442695040888963407u;
        const auto mixed = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto turn = static_cast<std::uint32_t>(old >> 59u);
        return (mixed >> turn) | (mixed << ((32u - turn) & 31u));
    }
    /// Uniform in [low, high).
    double uniform(double low = 0.0, double high = 1.0) {
        return low + (high - low) * (next() / 4294967296.0);
    }
    /// Uniform in 0 .. count - 1.
    int below(int count) { return static_cast<int>(uniform(0.0, count)); }

 private:
    std::uint64_t state_;
};

}  // namespace penumbra::assets
