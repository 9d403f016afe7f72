#include "chapters/06_jitter_texture/void_and_cluster.h"

#include <algorithm>
#include <cmath>

#include "common/math/sampling.h"

namespace penumbra {

namespace {

/// Which texels are taken, and how crowded each place is: a sum of Gaussians around the taken ones.
class Crowd {
 public:
    explicit Crowd(int size)
        : size_(size),
          bell_(std::size_t(size) * size),
          crowding_(std::size_t(size) * size),
          taken_(std::size_t(size) * size) {
        constexpr double sigma = 1.9;  // Ulichney uses 1.5; a little wider serves sums over 3 x 3 better
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double dx = std::min(x, size - x), dy = std::min(y, size - y);
                bell_[y * size + x] = std::exp(-(dx * dx + dy * dy) / (2.0 * sigma * sigma));
            }
        }
    }

    void put(int texel, bool taken) {
        taken_[std::size_t(texel)] = taken;
        const int cx = texel % size_, cy = texel / size_;
        for (int y = 0; y < size_; ++y) {
            const int row = ((y - cy + size_) % size_) * size_;
            for (int x = 0; x < size_; ++x) {
                const double bell = bell_[row + (x - cx + size_) % size_];
                crowding_[y * size_ + x] += taken ? bell : -bell;
            }
        }
    }

    /// The taken texel in the tightest cluster, or the free one in the largest void.
    int extreme(bool taken) const {
        int best = -1;
        for (int i = 0; i < int(taken_.size()); ++i) {
            if (taken_[std::size_t(i)] != taken) continue;
            const double difference =
                best < 0 ? 1.0 : crowding_[std::size_t(i)] - crowding_[std::size_t(best)];
            if (best < 0 || (taken ? difference > 0.0 : difference < 0.0)) best = i;
        }
        return best;
    }

 private:
    int size_;
    std::vector<double> bell_, crowding_;
    std::vector<bool> taken_;
};

/// A tenth of the tile at random, then the tightest cluster moved into the largest void until that changes
/// nothing.
Crowd evenStart(int size, std::uint32_t seed, std::vector<int>& members) {
    Crowd crowd(size);
    const int texels = size * size, wanted = std::max(1, texels / 10);
    std::vector<bool> isMember(std::size_t(texels), false);
    for (std::uint32_t i = 0; int(members.size()) < wanted; ++i) {
        const int texel = int(hashSeed(i, 77, seed) % std::uint32_t(texels));
        if (isMember[std::size_t(texel)]) continue;
        isMember[std::size_t(texel)] = true;
        members.push_back(texel);
        crowd.put(texel, true);
    }
    for (int moves = 0; moves < texels; ++moves) {
        const int cluster = crowd.extreme(true);
        crowd.put(cluster, false);
        const int hole = crowd.extreme(false);
        crowd.put(hole, true);
        if (hole == cluster) break;
        *std::find(members.begin(), members.end(), cluster) = hole;
    }
    return crowd;
}

}  // namespace

// [begin:void-and-cluster]
std::vector<int> blueNoiseRanks(int size, std::uint32_t seed) {
    std::vector<int> members, ranks(std::size_t(size) * size);
    const Crowd start = evenStart(size, seed, members);

    // Down from the start: who is most crowded comes last.
    Crowd crowd = start;
    for (int rank = int(members.size()) - 1; rank >= 0; --rank) {
        const int cluster = crowd.extreme(true);
        crowd.put(cluster, false);
        ranks[std::size_t(cluster)] = rank;
    }
    // Up from the start: the largest void is filled next.
    crowd = start;
    for (int rank = int(members.size()); rank < size * size; ++rank) {
        const int hole = crowd.extreme(false);
        crowd.put(hole, true);
        ranks[std::size_t(hole)] = rank;
    }
    return ranks;
}
// [end:void-and-cluster]

}  // namespace penumbra
