#include "chapters/09_ambient_occlusion/edge_rays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/math/hemisphere.h"
#include "common/math/sampling.h"

namespace penumbra {

namespace {

/// Cells of equal weight, side x side, over the hemisphere about +z. The border of the square is the horizon.
struct Grid {
    int side = 0;
    Weighting weighting = Weighting::cosine;

    int cells() const { return side * side; }

    /// In the unit square of the cell. Both maps go over the same disk, so that cells are compact everywhere;
    /// uniformDirection would make slivers of them about the normal, with twice the length of border.
    glm::dvec3 direction(int cell, const glm::dvec2& u) const {
        const glm::dvec2 p = (glm::dvec2(cell % side, cell / side) + u) / double(side);
        if (weighting == Weighting::cosine) return cosineDirection(p);
        const glm::dvec2 disk = concentricDisk(p);
        const double z = 1.0 - std::min(1.0, glm::dot(disk, disk));  // areas of disk and hemisphere agree
        return {std::sqrt(1.0 + z) * disk, z};
    }
};

/// Means over a cell by the midpoint rule, in a t whose steps shrink to nothing at both ends: the height
/// above the horizon goes as a square root there, and even steps would be off by 4e-5 in the bent vector,
/// more than its error (the simplest of the substitutions of Korobov 1963, "Number-theoretic methods").
struct Step {
    double at = 0.0, weight = 0.0;
};

std::vector<Step> steps(int count) {
    std::vector<Step> result;
    for (int i = 0; i < count; ++i) {
        const double t = (i + 0.5) / count;
        result.push_back({t * t * t * (10.0 - 15.0 * t + 6.0 * t * t), 30.0 * t * t * (1.0 - t) * (1.0 - t)});
    }
    return result;
}

glm::dvec3 meanDirection(const Grid& grid, int cell) {
    static const std::vector<Step> few = steps(8), many = steps(32);
    // The map has a fold along the diagonals of the square.
    const int x = cell % grid.side, y = cell / grid.side;
    const std::vector<Step>& inCell = x == y || x + y == grid.side - 1 ? many : few;
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (const Step& i : inCell)
        for (const Step& j : inCell) {
            sum += i.weight * j.weight * grid.direction(cell, {i.at, j.at});
            weights += i.weight * j.weight;
        }
    return sum / weights;
}

/// Of each cell, made once for each thread.
std::span<const glm::dvec3> meanDirections(const Grid& grid) {
    thread_local std::map<std::pair<int, Weighting>, std::vector<glm::dvec3>> made;
    std::vector<glm::dvec3>& means = made[{grid.side, grid.weighting}];
    if (means.empty())
        for (int cell = 0; cell < grid.cells(); ++cell) means.push_back(meanDirection(grid, cell));
    return means;
}

/// One ray anywhere in each cell. They have nothing to do with one another: of points that avoid each other
/// the neighbours' would tell where in its cell this one is, and the mean would no longer be right.
std::vector<AmbientDirection> oneInEach(const Grid& grid, const glm::dmat3& worldFromNormal,
                                        std::uint32_t seed) {
    std::vector<AmbientDirection> directions(std::size_t(grid.cells()));
    for (std::uint32_t cell = 0; cell < directions.size(); ++cell) {
        const glm::dvec2 u(hashUnit(seed, cell, 1), hashUnit(seed, cell, 2));
        directions[cell].direction = worldFromNormal * grid.direction(int(cell), u);
    }
    return directions;
}

void ask(const RayTracer& tracer, const Hit& from, const AmbientRays& rays,
         std::span<AmbientDirection> directions, std::int64_t& asked) {
    traceDirections(tracer, from, rays, directions, asked);
    if (rays.nothingAbove) asked += std::ranges::count(directions, 1.0, &AmbientDirection::open);
}

// [begin:neighbours]
/// How open are all cells around this one, if they agree? Its own ray is not asked. Along the horizon three
/// to each side are: what is seen of a low bank is thinner than a cell there, and nothing is outside.
std::optional<double> neighboursSay(std::span<const AmbientDirection> first, int side, int cell) {
    constexpr int alongHorizon = 3;
    const int x = cell % side, y = cell / side;
    const bool level = y == 0 || y == side - 1, upright = x == 0 || x == side - 1;
    double least = 1.0, most = 0.0;
    const auto hear = [&](int i, int j) {
        if (i < 0 || j < 0 || i >= side || j >= side) return;
        const int asked = j * side + i;
        const double open = first[std::size_t(asked)].open;
        least = std::min(least, open);
        most = std::max(most, open);
    };
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            if (i != 0 || j != 0) hear(x + i, y + j);
    for (int away = 2; away <= alongHorizon; ++away) {
        if (level) hear(x - away, y), hear(x + away, y);
        if (upright) hear(x, y - away), hear(x, y + away);
    }
    return least == most ? std::optional(most) : std::nullopt;
}
// [end:neighbours]

/// As many rays as are left, shared among the cells, spread evenly in each. Returns the sum of the means of
/// the cells.
AmbientValue lookCloser(const RayTracer& tracer, const Hit& from, const glm::dmat3& worldFromNormal,
                        const Grid& grid, const AmbientRays& rays, std::span<const int> cells,
                        std::uint32_t seed, std::int64_t& asked) {
    const auto left = std::size_t(rays.count - grid.cells());
    const auto begin = [&](std::size_t i) { return left * i / cells.size(); };
    std::vector<AmbientDirection> directions(cells.empty() ? 0 : left);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t here = hashSeed(seed, std::uint32_t(cells[i]), 3);
        for (std::size_t k = begin(i); k < begin(i + 1); ++k)
            directions[k].direction =
                worldFromNormal * grid.direction(cells[i], owenSobol(std::uint32_t(k - begin(i)), here));
    }
    ask(tracer, from, rays, directions, asked);
    AmbientValue sum{0.0, glm::dvec3(0.0)};
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const AmbientValue mean = averageOf(std::span(directions).subspan(begin(i), begin(i + 1) - begin(i)));
        sum.visibility += mean.visibility;
        sum.bent += mean.bent;
    }
    return sum;
}

}  // namespace

// [begin:edges]
AmbientValue estimateAtEdges(const RayTracer& tracer, const Hit& from, const glm::dvec3& normal,
                             const AmbientRays& rays, std::uint32_t seed, std::int64_t& asked) {
    // No more than half of the rays: then one is left for every cell, should none agree with another.
    const Grid grid{int(std::sqrt(0.5 * rays.count)), rays.weighting};
    const glm::dmat3 worldFromNormal = frameAround(normal);
    const std::span<const glm::dvec3> means = meanDirections(grid);
    std::vector<AmbientDirection> first = oneInEach(grid, worldFromNormal, seed);
    ask(tracer, from, rays, first, asked);

    std::vector<int> unclear;
    double visibility = 0.0;
    glm::dvec3 likely(0.0), unlikely(0.0);
    for (int cell = 0; cell < grid.cells(); ++cell) {
        const std::optional<double> said = neighboursSay(first, grid.side, cell);
        if (!said) {
            unclear.push_back(cell);
            continue;
        }
        // The whole cell is likely to be as its neighbours are; its own ray puts that right where it is not.
        // So a cell that agrees has no error, and on average none has.
        const AmbientDirection& own = first[std::size_t(cell)];
        visibility += own.open;
        likely += *said * means[std::size_t(cell)];
        unlikely += (own.open - *said) * own.direction;
    }
    const AmbientValue closer = lookCloser(tracer, from, worldFromNormal, grid, rays, unclear, seed, asked);
    const double cells = grid.cells();
    return {(visibility + closer.visibility) / cells,
            (worldFromNormal * likely + unlikely + closer.bent) / cells};
}
// [end:edges]

}  // namespace penumbra
