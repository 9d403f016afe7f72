// Patterns on the disk: where their points lie, and how fast the filter's error falls.
#include "chapters/05_jittered_disk/disk_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "common/error.h"
#include "tests/unit/disk_pattern_errors.h"

namespace penumbra {
namespace {

constexpr std::array patterns{SquarePattern::random, SquarePattern::regular, SquarePattern::jittered,
                              SquarePattern::fibonacci, SquarePattern::sobol};
constexpr std::array counts{16, 64, 256, 1024};

std::string nameOf(SquarePattern pattern) {
    return squarePatternNames()[std::size_t(pattern)];
}

TEST(DiskPattern, PointsLieInSquareAndDiskForAnyCount) {
    for (const auto pattern : patterns) {
        for (const int count : {4, 5, 7, 16, 31, 64, 97, 1024}) {
            const auto points = squarePoints(pattern, count, 3);
            ASSERT_EQ(points.size(), std::size_t(count));
            for (const glm::dvec2& p : points) {
                EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << nameOf(pattern) << count;
                for (const auto map : {DiskMap::concentric, DiskMap::polar, DiskMap::polarLinear})
                    EXPECT_LE(glm::length(onDisk(map, p)), 1.0 + 1e-15);
            }
        }
    }
}

TEST(DiskPattern, TheSeedDecides) {
    for (const auto pattern : patterns) {
        EXPECT_EQ(squarePoints(pattern, 16, 1), squarePoints(pattern, 16, 1)) << nameOf(pattern);
        const glm::dvec2 one = squarePoints(pattern, 16, 1)[0], two = squarePoints(pattern, 16, 2)[0];
        EXPECT_TRUE(one.x != two.x && one.y != two.y) << nameOf(pattern);
    }
}

/// Of a grid of 8 x 8: the number of cells that hold a point.
std::size_t cellsHit(SquarePattern pattern, std::uint32_t seed) {
    std::set<int> cells;
    for (const glm::dvec2& p : squarePoints(pattern, 64, seed)) cells.insert(int(p.y * 8) * 8 + int(p.x * 8));
    return cells.size();
}

TEST(DiskPattern, EveryCellOfAGridHoldsOnePoint) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        EXPECT_EQ(cellsHit(SquarePattern::regular, seed), 64u);
        EXPECT_EQ(cellsHit(SquarePattern::jittered, seed), 64u);
        EXPECT_EQ(cellsHit(SquarePattern::sobol, seed), 64u);   // an elementary interval of a net
        EXPECT_LT(cellsHit(SquarePattern::random, seed), 55u);  // 64 (1 - 1/e) = 40
    }
}

TEST(DiskPattern, RowsOfAnOddCountHoldWhatTheirHeightSays) {
    // 31 points: 6 rows of 5 or 6 cells, of which all have the same area.
    for (const auto& [count, inFirstRows] : {std::pair(31, 15), std::pair(5, 2), std::pair(7, 2)}) {
        const double height = double(inFirstRows) / count;
        for (std::uint32_t seed = 0; seed < 50; ++seed) {
            const auto points = squarePoints(SquarePattern::jittered, count, seed);
            const auto below = [&](const glm::dvec2& p) { return p.y < height; };
            EXPECT_EQ(std::count_if(points.begin(), points.end(), below), inFirstRows) << count;
        }
    }
}

TEST(DiskPattern, TheMapsKeepAreas) {
    for (const auto map : {DiskMap::concentric, DiskMap::polar, DiskMap::polarLinear}) {
        double second = 0;
        const auto points = diskPattern(SquarePattern::jittered, map, 4096, 1);
        for (const glm::dvec2& p : points) second += glm::dot(p, p) / double(points.size());
        // The mean of r^2 over a disk is 1/2; without the root, that of v^2: 1/3.
        EXPECT_NEAR(second, map == DiskMap::polarLinear ? 1.0 / 3.0 : 0.5, 0.003);
    }
}

// --- errors ---

struct Row {
    SquarePattern pattern;
    DiskMap map;
    std::array<double, 4> rms;  ///< at `counts` points
    double slope;
};

/// Measured for the course over 600 random edges, with other random numbers and other code.
constexpr Row table[] = {
    {SquarePattern::random, DiskMap::concentric, {.098, .048, .024, .011}, -.51},
    {SquarePattern::regular, DiskMap::concentric, {.079, .036, .017, .0089}, -.51},
    {SquarePattern::jittered, DiskMap::concentric, {.049, .017, .0064, .0022}, -.75},
    {SquarePattern::sobol, DiskMap::concentric, {.039, .014, .0054, .0018}, -.74},
    {SquarePattern::fibonacci, DiskMap::concentric, {.043, .015, .0046, .0015}, -.78},
    {SquarePattern::jittered, DiskMap::polar, {.058, .022, .0080, .0028}, -.74},
    {SquarePattern::fibonacci, DiskMap::polar, {.036, .0125, .0046, .0015}, -.77},
};

struct Fit {
    double worstRatio = 1.0;  ///< of measured and expected, furthest from 1
    double slope = 0.0;       ///< of log rms over log count
};

Fit fit(const Row& row, SquarePattern pattern, DiskMap map) {
    constexpr int trials = 600;
    Fit result;
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double rms = patternErrors(pattern, map, counts[i], trials).rms, ratio = rms / row.rms[i];
        if (std::abs(std::log(ratio)) > std::abs(std::log(result.worstRatio))) result.worstRatio = ratio;
        const double x = std::log(counts[i]), y = std::log(rms);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double n = counts.size();
    result.slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return result;
}

bool matches(const Row& row, const Fit& f) {
    return f.worstRatio > 0.85 && f.worstRatio < 1.15 && std::abs(f.slope - row.slope) < 0.05;
}

TEST(DiskPattern, ErrorsFallAsMeasuredBefore) {
    for (const Row& row : table) {
        const Fit f = fit(row, row.pattern, row.map);
        EXPECT_TRUE(matches(row, f)) << nameOf(row.pattern) << " on " << diskMapNames()[std::size_t(row.map)]
                                     << ": worst ratio " << f.worstRatio << ", slope " << f.slope;
    }
}

TEST(DiskPattern, WrongPatternsDoNotMatchTheTable) {
    // Unstratified, and without the square root.
    for (const Row& row : table) {
        if (row.pattern != SquarePattern::random) {
            EXPECT_FALSE(matches(row, fit(row, SquarePattern::random, row.map)));
        }
        EXPECT_FALSE(matches(row, fit(row, row.pattern, DiskMap::polarLinear)));
    }
}

TEST(DiskPattern, SixteenStratifiedPointsAreAsGoodAsSixtyFourRandomOnes) {
    const double random = patternErrors(SquarePattern::random, DiskMap::concentric, 64, 2000).rms;
    EXPECT_LT(patternErrors(SquarePattern::jittered, DiskMap::concentric, 16, 2000).rms, 1.15 * random);
    EXPECT_LT(patternErrors(SquarePattern::sobol, DiskMap::concentric, 16, 2000).rms, random);
}

/// Mean error in standard errors.
double zScore(SquarePattern pattern, DiskMap map, int count) {
    constexpr int trials = 4000;
    const PatternErrors e = patternErrors(pattern, map, count, trials);
    return e.mean * std::sqrt(double(trials)) / e.rms;
}

TEST(DiskPattern, MeansAreUnbiased) {
    // 40 scores; |z| > 4.6 has a probability of 4e-6: a false alarm in one of 6000 choices of the random
    // numbers.
    for (const auto pattern : patterns)
        for (const auto map : {DiskMap::concentric, DiskMap::polar})
            for (const int count : {5, 16, 31, 64})
                EXPECT_LT(std::abs(zScore(pattern, map, count)), 4.6) << nameOf(pattern) << ", " << count;
    EXPECT_GT(std::abs(zScore(SquarePattern::sobol, DiskMap::polarLinear, 64)), 10.0) << "a bias is seen";
}

TEST(DiskPattern, WithoutTheSquareRootItNeverConverges) {
    // Symmetric edges cancel; at one distance they don't. The worst is 0.088, at 0.29 of the radius.
    double worst = 0;
    const auto points = diskPattern(SquarePattern::sobol, DiskMap::polarLinear, 1 << 16, 1);
    const auto good = diskPattern(SquarePattern::sobol, DiskMap::polar, 1 << 16, 1);
    for (double d = 0.01; d < 1.0; d += 0.01) {
        worst = std::max(worst, std::abs(litShare(points, {1, 0}, d) - diskCoverage(d, 1.0)));
        EXPECT_NEAR(litShare(good, {1, 0}, d), diskCoverage(d, 1.0), 1e-3);
    }
    EXPECT_NEAR(worst, 0.088, 0.001);
}

TEST(DiskPattern, NamesAreChecked) {
    for (std::size_t i = 0; i < squarePatternNames().size(); ++i)
        EXPECT_EQ(std::size_t(squarePattern(squarePatternNames()[i])), i);
    for (std::size_t i = 0; i < diskMapNames().size(); ++i)
        EXPECT_EQ(std::size_t(diskMap(diskMapNames()[i])), i);
    EXPECT_EQ(squarePattern("random"), SquarePattern::random);
    EXPECT_EQ(squarePattern("regular"), SquarePattern::regular);
    EXPECT_EQ(squarePattern("jittered"), SquarePattern::jittered);
    EXPECT_EQ(squarePattern("fibonacci"), SquarePattern::fibonacci);
    EXPECT_EQ(squarePattern("sobol"), SquarePattern::sobol);
    EXPECT_EQ(diskMap("concentric"), DiskMap::concentric);
    EXPECT_EQ(diskMap("polar"), DiskMap::polar);
    EXPECT_EQ(diskMap("polar-linear"), DiskMap::polarLinear);
    EXPECT_THROW(squarePattern("rings"), UsageError);
    EXPECT_THROW(diskMap("square"), UsageError);
}

}  // namespace
}  // namespace penumbra
