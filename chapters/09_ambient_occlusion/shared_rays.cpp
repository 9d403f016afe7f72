#include "chapters/09_ambient_occlusion/shared_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/math/hemisphere.h"
#include "common/math/wide.h"
#include "common/truth/parallel.h"

namespace penumbra {

namespace {

constexpr int pointsAtOnce = 256;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Neighbours asked, the point itself included. Fewer: more rays are needed, with 32 a fifth more; more: on a
/// sharp gully a tenth more error, since they are farther away.
constexpr std::size_t most = 40;
constexpr std::size_t fewest = 6;
/// Cosine to the normal beyond which a neighbour is around a corner.
constexpr float sameSide = 0.75f;

/// Halves of one lattice are not independent: each covers what the other leaves out, and the whole has less
/// variance than the mean of two independent ones, by this factor (tests/bench/ambient_bench.cpp prints it:
/// 2.1 to 3.1).
constexpr float halvesOverNoise = 2.2f;
constexpr float leastNoise = 1e-8f;

/// What rounding leaves of a coefficient that the neighbours do not determine, as on a round wall, where the
/// places say what the normals say: sums over 40 neighbours of up to 1, in float.
constexpr float rounding = 1e-5f;

/// Beyond this multiple of the noise the neighbours' differences are not noise. With 0.8 much noise is taken
/// for more than that, and a quarter more rays are wasted; with 1.5 the error on a sharp gully grows.
constexpr float explained = 1.1f;

/// Coefficients of the function: two along the surface, two with the normal, one with the depth, three of
/// second degree, and the constant last: eliminated in this order, the constant is what remains. Each is
/// believed to be of the size `believed`, for a neighbourhood of radius 1 and a change of the normal by 1.
constexpr std::size_t terms = 9, width = 16;
constexpr std::array<float, terms> believed = {0.15f, 0.15f, 0.5f, 0.5f, 0.5f, 0.1f, 0.1f, 0.1f, 1e3f};

/// The terms of a neighbour and then its differences of value to the point; padded for the compiler, which
/// does many at a time.
struct alignas(64) Row : std::array<float, width> {};

/// [M | b] of the normal equations, and the sum of squares of the visibilities.
struct Equations {
    std::array<Row, terms> rows{};
    float squares = 0.0f;
};

PENUMBRA_WIDE void add(std::span<const Row> added, Equations& equations) {
    for (std::size_t a = 0; a < terms; ++a) {
        Row sum{};
        for (const Row& row : added)
            for (std::size_t b = 0; b < width; ++b) sum[b] += row[a] * row[b];
        equations.rows[a] = sum;
    }
    for (const Row& row : added) equations.squares += row[terms + 3] * row[terms + 3];
}

/// Gaussian elimination; afterwards the last row holds only the constant, and `squares` what the function
/// leaves unexplained.
PENUMBRA_WIDE void eliminate(float noise, Equations& equations) {
    auto& [rows, squares] = equations;
    for (std::size_t a = 0; a < terms; ++a) rows[a][a] += noise / (believed[a] * believed[a]);
    for (std::size_t a = 0; a < terms; ++a) {
        const float inverse = 1.0f / std::max(rounding, rows[a][a]);
        squares -= rows[a][terms + 3] * rows[a][terms + 3] * inverse;
        for (std::size_t b = a + 1; b < terms; ++b) {
            const float factor = rows[b][a] * inverse;
            for (std::size_t c = 0; c < width; ++c) rows[b][c] -= factor * rows[a][c];
        }
    }
}

/// Per thread: when each point was last seen by the search below.
struct Seen {
    std::vector<std::uint32_t> stamps;
    std::uint32_t now = 0;

    void begin(std::size_t points) {
        if (stamps.size() != points || ++now == 0) {
            stamps.assign(points, 0);
            now = 1;
        }
    }
    bool first(std::uint32_t i) {
        if (stamps[i] == now) return false;
        stamps[i] = now;
        return true;
    }
};

}  // namespace

SharedRays::SharedRays(const BakePoints& points, const PointNeighbours& neighbours,
                       std::span<const OwnEstimate> own)
    : points_(points),
      neighbours_(neighbours),
      own_(own),
      depths_(points.points.size(), 0.0f),
      noises_(points.points.size(), 0.0f) {
    forEachPoint([&](std::uint32_t i) { depths_[i] = depthOf(i); });
    update();
}

void SharedRays::update() {
    forEachPoint([&](std::uint32_t i) { noises_[i] = noiseAround(i); });
}

template <class Body>
void SharedRays::forEachPoint(const Body& body) const {
    const int count = int(depths_.size());
    parallelRows((count + pointsAtOnce - 1) / pointsAtOnce, [&](int row) {
        for (int i = row * pointsAtOnce; i < std::min(count, (row + 1) * pointsAtOnce); ++i)
            body(std::uint32_t(i));
    });
}

/// How deep a point lies between its neighbours, -1 to 1.
float SharedRays::depthOf(std::uint32_t i) const {
    const BakePoint& point = points_.points[i];
    glm::vec3 sum(0.0f);
    float lengths = 0.0f;
    for (const std::uint32_t j : neighbours_.of(i)) {
        const glm::vec3 to = points_.points[j].position - point.position;
        sum += to;
        lengths += glm::length(to);
    }
    return lengths > 0.0f ? glm::dot(sum, point.normal) / lengths : 0.0f;
}

/// The halves of one point say little about its noise, those of all around it more: what its neighbours say
/// is a mean over forty of these.
float SharedRays::noiseAround(std::uint32_t i) const {
    float halves = own_[i].halves;
    for (const std::uint32_t j : neighbours_.of(i)) halves += own_[j].halves;
    return halves / (halvesOverNoise * float(neighbours_.of(i).size() + 1));
}

/// The nearest points along the surface, in rings; `i` first.
std::span<const std::uint32_t> SharedRays::around(std::uint32_t i) const {
    thread_local Seen seen;
    thread_local std::array<std::uint32_t, most> found;
    seen.begin(points_.points.size());
    seen.first(i);
    std::size_t count = 0;
    found[count++] = i;
    const glm::vec3 normal = points_.points[i].normal;
    for (std::size_t next = 0; next < count; ++next)
        for (const std::uint32_t j : neighbours_.of(found[next])) {
            if (!seen.first(j) || glm::dot(points_.points[j].normal, normal) < sameSide) continue;
            found[count++] = j;
            if (count == most) return found;
        }
    return {found.data(), count};
}

NeighbourEstimate SharedRays::at(std::uint32_t i) const {
    const std::span<const std::uint32_t> near = around(i);
    const BakePoint& point = points_.points[i];
    const glm::mat3 localFromWorld = glm::transpose(glm::mat3(frameAround(glm::dvec3(point.normal))));
    std::array<glm::vec3, most> places;
    float radius = 0.0f, noise = 0.0f;
    for (std::size_t k = 0; k < near.size(); ++k) {
        places[k] = localFromWorld * (points_.points[near[k]].position - point.position);
        radius = std::max(radius, places[k].x * places[k].x + places[k].y * places[k].y);
        noise += noises_[near[k]];
    }
    noise = std::max(leastNoise, noise / float(near.size()));
    if (near.size() < fewest || !(radius > 0.0f)) return {own_[i].value, infinity, noise};

    const float perRadius = 1.0f / std::sqrt(radius);
    std::array<Row, most> added;
    for (std::size_t k = 0; k < near.size(); ++k) {
        const float x = places[k].x * perRadius, y = places[k].y * perRadius;
        const glm::vec3 normal = localFromWorld * points_.points[near[k]].normal;
        const glm::vec4 change = own_[near[k]].value - own_[i].value;
        added[k] = {{x, y, normal.x, normal.y, depths_[near[k]] - depths_[i], x * x, x * y, y * y, 1.0f,
                     change.x, change.y, change.z, change.w}};
    }
    Equations equations;
    add({added.data(), near.size()}, equations);
    eliminate(noise, equations);
    const Row& constant = equations.rows[terms - 1];
    // Without the point itself, whose own value is then weighed against it: the usual leave-one-out identity,
    // with the point's share in the constant. If that is nearly all of it, the others do not know.
    const float share = 1.0f / constant[terms - 1];
    if (!(share > 0.0f && share < 0.99f)) return {own_[i].value, infinity, noise};
    const glm::vec4 change(constant[terms], constant[terms + 1], constant[terms + 2], constant[terms + 3]);
    const float others = share / (1.0f - share);
    const float unexplained =
        std::max(0.0f, std::max(0.0f, equations.squares) / float(near.size() - 1) - explained * noise);
    return {own_[i].value + change / (constant[terms - 1] * (1.0f - share)),
            others * (noise + unexplained) + unexplained, noise};
}

float combine(glm::vec4& value, float variance, const glm::vec4& other, float otherVariance) {
    if (std::isinf(otherVariance)) return variance;
    if (std::isinf(variance)) {
        value = other;
        return otherVariance;
    }
    const float weight = variance + otherVariance > 0.0f ? variance / (variance + otherVariance) : 0.5f;
    value += weight * (other - value);
    return weight * otherVariance;
}

float thresholdOfMean(std::vector<float> variances, double mean) {
    std::ranges::sort(variances);
    double below = 0.0;
    for (std::size_t i = 0; i < variances.size(); ++i) {
        // If the threshold is at most variances[i], those from i on count as the threshold.
        const double threshold = (mean * double(variances.size()) - below) / double(variances.size() - i);
        if (threshold <= variances[i]) return float(std::max(0.0, threshold));
        below += variances[i];
    }
    return infinity;
}

}  // namespace penumbra
