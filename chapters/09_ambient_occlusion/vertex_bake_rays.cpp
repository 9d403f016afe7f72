#include "chapters/09_ambient_occlusion/vertex_bake_rays.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "common/math/sampling.h"

namespace penumbra {

namespace {

double unitHash(std::uint32_t seed, std::uint32_t which) {
    return hashSeed(seed, which) * 0x1p-32;
}

/// The directions of the lattice one after the other, in the point's local frame: (i + 1/2) / count, shifted,
/// is the square of the distance from the disk's centre (or the height on the hemisphere), and the angle
/// grows by the golden section of a turn each time, which needs a product instead of a sine and a cosine.
class Lattice {
 public:
    Lattice(const AmbientRays& rays, std::uint32_t seed)
        : cosine_(rays.weighting == Weighting::cosine),
          step_(1.0 / rays.count),
          x_(unitHash(seed, 1) + 0.5 * step_) {
        const double angle = 2.0 * std::numbers::pi * unitHash(seed, 2);
        c_ = std::cos(angle), s_ = std::sin(angle);
    }

    glm::vec3 next() {
        x_ -= x_ >= 1.0 ? 1.0 : 0.0;
        const auto x = float(x_);
        const float z = cosine_ ? std::sqrt(1.0f - x) : 1.0f - x;
        const float r = std::sqrt(cosine_ ? x : 1.0f - z * z);
        const glm::vec3 direction(r * float(c_), r * float(s_), z);
        x_ += step_;
        const double turned = c_ * turnCos - s_ * turnSin;
        s_ = s_ * turnCos + c_ * turnSin;
        c_ = turned;
        return direction;
    }

 private:
    // Of 2 pi (golden section - 1).
    static constexpr double turnCos = -0.73736887807831963, turnSin = -0.67549029426152396;
    bool cosine_;
    double step_, x_, c_ = 1.0, s_ = 0.0;
};

/// Rays that start above the surface, those that go out in similar directions one after the other: Embree
/// traces them side by side, and they stay together on their way.
class RayList {
 public:
    void clear() { count_ = 0; }
    void add(const BundleRay& ray, const glm::vec3& local, int index) {
        if (unsorted_.size() == count_) unsorted_.emplace_back();
        const int sector = (local.y < 0.0f ? 4 : 0) + (local.x < 0.0f ? 2 : 0) +
                           (std::abs(local.x) < std::abs(local.y) ? 1 : 0);
        // Around the circle: 0 1 3 2 6 7 5 4.
        constexpr std::array<std::uint8_t, sectors> order = {0, 1, 3, 2, 7, 6, 4, 5};
        unsorted_[count_++] = {ray, order[std::size_t(sector)], index % 2 == 0};
    }
    void sort() {
        std::array<std::size_t, sectors + 1> first{};
        for (std::size_t i = 0; i < count_; ++i) ++first[unsorted_[i].sector + 1u];
        for (std::size_t s = 1; s < sectors; ++s) first[s] += first[s - 1];
        rays_.resize(count_), even_.resize(count_), blocked_.resize(count_);
        for (std::size_t i = 0; i < count_; ++i) {
            const std::size_t place = first[unsorted_[i].sector]++;
            rays_[place] = unsorted_[i].ray;
            even_[place] = unsorted_[i].even;
        }
    }
    std::span<const BundleRay> rays() const { return rays_; }
    double even(std::size_t i) const { return even_[i]; }  ///< 1 or 0
    std::span<std::uint8_t> blocked() { return blocked_; }

 private:
    static constexpr std::size_t sectors = 8;
    struct Unsorted {
        BundleRay ray;
        std::uint8_t sector = 0;
        bool even = false;
    };
    std::vector<Unsorted> unsorted_;
    std::size_t count_ = 0;
    std::vector<BundleRay> rays_;
    std::vector<std::uint8_t> even_, blocked_;
};

}  // namespace

RaySums tracePoint(const RayBundle& bundle, const PointFan& fan, const AmbientRays& rays, std::uint32_t seed,
                   std::int64_t& traced) {
    thread_local RayList list;
    list.clear();
    Lattice lattice(rays, seed);
    for (int i = 0; i < rays.count; ++i) {
        const glm::vec3 local = lattice.next();
        const glm::vec3 world = fan.worldFromLocal() * local;
        if (const glm::vec3* origin = fan.origin(local, world)) list.add({*origin, world}, local, i);
    }
    list.sort();
    const auto range = float(rays.reach.range);
    const bool smooth = rays.reach.smooth && std::isfinite(range);
    bundle.blocked(list.rays(), range, list.blocked());
    traced += std::int64_t(list.rays().size());
    RaySums sums;
    for (std::size_t i = 0; i < list.rays().size(); ++i) {
        const BundleRay& ray = list.rays()[i];
        // No branch: half of the rays are blocked, and no processor guesses which.
        double open = 1.0 - list.blocked()[i];
        if (smooth && open == 0.0) open = openAt(double(bundle.distance(ray, range)), rays.reach);
        sums.visibility += open;
        sums.bent += open * glm::dvec3(ray.direction);
        sums.everyOther += list.even(i) * open;
    }
    return sums;
}

AmbientValue wholeSky(const glm::dvec3& normal, Weighting weighting) {
    return {1.0, (weighting == Weighting::cosine ? 2.0 / 3.0 : 0.5) * normal};
}

}  // namespace penumbra
