#include "chapters/09_ambient_occlusion/vertex_bake_rays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "common/math/sampling.h"

namespace penumbra {

namespace {

/// One direction of the lattice, before it is shifted and turned.
struct Spoke {
    float x = 0.0f;  ///< square of the distance from the disk's centre, or 1 - the height on the hemisphere
    float cosine = 1.0f, sine = 0.0f;  ///< of the angle around the normal
    float even = 0.0f;                 ///< 1: number 0, 2, 4 ... of the lattice
};

/// The angle of one after the other grows by the golden section of a turn, and x by 1 / count; a part has
/// every other one of twice as many, so that the two parts together are a lattice. Sorted by the angle:
/// Embree traces neighbours side by side, and those that go out over the same side of the point stay together
/// on their way.
std::vector<Spoke> latticeSpokes(int count, LatticePart part) {
    constexpr double golden = 0.61803398874989485;
    const int stride = part == LatticePart::whole ? 1 : 2, begin = part == LatticePart::odd ? 1 : 0;
    std::vector<std::pair<double, Spoke>> sorted;
    for (int i = 0; i < count; ++i) {
        const int number = begin + stride * i;
        const double turns = number * golden, angle = 2.0 * std::numbers::pi * turns;
        sorted.push_back({turns - std::floor(turns),
                          {float((number + 0.5) / (stride * double(count))), float(std::cos(angle)),
                           float(std::sin(angle)), i % 2 == 0 ? 1.0f : 0.0f}});
    }
    std::ranges::sort(sorted, {}, [](const auto& entry) { return entry.first; });
    std::vector<Spoke> spokes;
    for (const auto& [turns, spoke] : sorted) spokes.push_back(spoke);
    return spokes;
}

/// The same, made once for each thread.
std::span<const Spoke> spokesOf(int count, LatticePart part) {
    thread_local std::map<std::pair<int, LatticePart>, std::vector<Spoke>> made;
    std::vector<Spoke>& spokes = made[{count, part}];
    if (spokes.empty()) spokes = latticeSpokes(count, part);
    return spokes;
}

/// The rays that start above the surface; `even` is that of their spokes.
struct RayList {
    std::vector<BundleRay> rays;
    std::vector<float> even;
    std::vector<std::uint8_t> blocked;
    std::size_t count = 0;

    void begin(std::size_t most) {
        if (rays.size() < most) rays.resize(most), even.resize(most), blocked.resize(most);
        count = 0;
    }
};

void castRays(const PointFan& fan, const AmbientRays& asked, std::uint32_t seed, LatticePart part,
              RayList& list) {
    const auto shift = float(hashUnit(seed, 1)),
               turn = 2.0f * std::numbers::pi_v<float> * float(hashUnit(seed, 2));
    const float cosine = std::cos(turn), sine = std::sin(turn);
    const bool byCosine = asked.weighting == Weighting::cosine;
    list.begin(std::size_t(asked.count));
    for (const Spoke& spoke : spokesOf(asked.count, part)) {
        float x = spoke.x + shift;
        x = x >= 1.0f ? x - 1.0f : x;
        const float z = byCosine ? std::sqrt(1.0f - x) : 1.0f - x;
        const float r = std::sqrt(byCosine ? x : 1.0f - z * z);
        const glm::vec3 local(r * (cosine * spoke.cosine - sine * spoke.sine),
                              r * (sine * spoke.cosine + cosine * spoke.sine), z);
        const glm::vec3 world = fan.worldFromLocal() * local;
        const glm::vec3* origin = fan.origin(local, world);
        if (!origin) continue;
        list.rays[list.count] = {*origin, world};
        list.even[list.count++] = spoke.even;
    }
}

}  // namespace

RaySums tracePoint(const RayBundle& bundle, const PointFan& fan, const AmbientRays& rays, std::uint32_t seed,
                   std::int64_t& traced, LatticePart part) {
    thread_local RayList list;
    castRays(fan, rays, seed, part, list);
    const auto range = float(rays.reach.range);
    const bool smooth = rays.reach.smooth && std::isfinite(range);
    bundle.blocked({list.rays.data(), list.count}, range, list.blocked);
    traced += std::int64_t(list.count);
    RaySums sums;
    for (std::size_t i = 0; i < list.count; ++i) {
        const BundleRay& ray = list.rays[i];
        // No branch: half of the rays are blocked, and no processor guesses which.
        double open = 1.0 - list.blocked[i];
        if (smooth && open == 0.0) open = openAt(double(bundle.distance(ray, range)), rays.reach);
        sums.visibility += open;
        sums.bent += open * glm::dvec3(ray.direction);
        sums.everyOther += double(list.even[i]) * open;
    }
    return sums;
}

AmbientValue wholeSky(const glm::dvec3& normal, Weighting weighting) {
    return {1.0, (weighting == Weighting::cosine ? 2.0 / 3.0 : 0.5) * normal};
}

}  // namespace penumbra
