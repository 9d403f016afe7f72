// Clusters, the watertight test, and the merging of light polygons.
#include "common/scene/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "common/math/aabb.h"
#include "common/scene/closed.h"
#include "common/scene/convex_merge.h"
#include "tests/unit/scene_meshes.h"

namespace penumbra {
namespace {

using Triple = std::array<std::uint32_t, 3>;

/// Triangles as index triples starting at the least index: winding kept.
std::multiset<Triple> triples(const std::vector<std::uint32_t>& indices) {
    std::multiset<Triple> set;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        Triple triple = {indices[t], indices[t + 1], indices[t + 2]};
        std::rotate(triple.begin(), std::min_element(triple.begin(), triple.end()), triple.end());
        set.insert(triple);
    }
    return set;
}

TestMesh shuffledBall() {
    TestMesh mesh = ball({1, 2, 3}, 2.0f, 60, 80);
    std::vector<Triple> triangles;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        triangles.push_back({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]});
    }
    std::mt19937 random(3);
    std::shuffle(triangles.begin(), triangles.end(), random);
    mesh.indices.clear();
    for (const Triple& t : triangles) mesh.indices.insert(mesh.indices.end(), t.begin(), t.end());
    return mesh;
}

TEST(Clusters, AreARearrangementInFullGroups) {
    const TestMesh mesh = shuffledBall();
    std::vector<std::uint32_t> indices = mesh.indices;
    const std::vector<std::uint32_t> sizes = clusterTriangles(mesh.positions, indices);
    EXPECT_EQ(triples(indices), triples(mesh.indices));
    const std::size_t triangles = indices.size() / 3;
    ASSERT_EQ(sizes.size(), (triangles + maxClusterTriangles - 1) / maxClusterTriangles);
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) EXPECT_EQ(sizes[i], maxClusterTriangles);
    EXPECT_EQ(sizes.back(), triangles - (sizes.size() - 1) * maxClusterTriangles);
}

TEST(Clusters, AreCompact) {
    const TestMesh mesh = shuffledBall();
    std::vector<std::uint32_t> indices = mesh.indices;
    double surface = 0.0;
    std::size_t first = 0;
    const auto sizes = clusterTriangles(mesh.positions, indices);
    for (const std::uint32_t size : sizes) {
        Aabb box;
        for (std::size_t i = 3 * first; i < 3 * (first + size); ++i)
            box.extend(glm::dvec3(mesh.positions[indices[i]]));
        const glm::dvec3 s = box.size();
        surface += s.x * s.y + s.y * s.z + s.z * s.x;
        first += size;
    }
    // A flat patch of area A throws shadows on the three axis planes of at most sqrt(3) A together, and a
    // rectangle is at least half of its box. Shuffled, every box would be the whole ball: 48.
    const double patch = 4.0 * 3.14159265358979 * 2.0 * 2.0 / double(sizes.size());
    EXPECT_LT(surface / double(sizes.size()), 2.0 * std::sqrt(3.0) * patch);
}

TEST(Clusters, DependOnTheInputAlone) {
    const TestMesh mesh = shuffledBall();
    std::vector<std::uint32_t> first = mesh.indices, second = mesh.indices;
    EXPECT_EQ(clusterTriangles(mesh.positions, first), clusterTriangles(mesh.positions, second));
    EXPECT_EQ(first, second);
}

TEST(Clusters, ManyTrianglesOfOneCentre) {
    // All centres equal: the median must still halve them.
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        positions.push_back(glm::vec3(i % 3 == 0, i % 3 == 1, i % 3 == 2));
        indices.push_back(i);
    }
    EXPECT_EQ(clusterTriangles(positions, indices).size(), 4u);
    // Ties go by the triangle's number, on every machine.
    for (std::size_t i = 0; i < indices.size(); ++i)
        EXPECT_EQ(indices[i] / (3 * maxClusterTriangles), i / (3 * maxClusterTriangles)) << i;
    std::vector<std::uint32_t> none;
    EXPECT_TRUE(clusterTriangles({}, none).empty());
}

TEST(Closed, ABallIsAndABallWithAHoleIsNot) {
    TestMesh mesh = ball({0, 0, 0}, 1.0f, 8, 12);
    EXPECT_TRUE(isClosed(mesh.positions, mesh.indices));
    mesh.indices.resize(mesh.indices.size() - 3);
    EXPECT_FALSE(isClosed(mesh.positions, mesh.indices));
    EXPECT_FALSE(isClosed(mesh.positions, {}));
}

TEST(Closed, ABoxWithoutItsLidIsOpenHoweverItsCornersAreNumbered) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    const std::vector<std::uint32_t> box = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                            2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    std::array<std::uint32_t, 8> number = {0, 1, 2, 3, 4, 5, 6, 7};
    do {
        std::vector<glm::vec3> positions(8);
        for (std::size_t i = 0; i < 8; ++i) positions[number[i]] = corners[i];
        std::vector<std::uint32_t> indices;
        for (const std::uint32_t i : box) indices.push_back(number[i]);
        ASSERT_TRUE(isClosed(positions, indices));
        indices.resize(indices.size() - 6);
        ASSERT_FALSE(isClosed(positions, indices));
    } while (std::next_permutation(number.begin(), number.end()));
}

TEST(Closed, OneFlippedTriangleOpensIt) {
    TestMesh mesh = ball({0, 0, 0}, 1.0f, 8, 12);
    std::swap(mesh.indices[30], mesh.indices[31]);
    EXPECT_FALSE(isClosed(mesh.positions, mesh.indices));
}

TEST(Closed, EveryShellMustLookOutwards) {
    TestMesh inside = ball({0, 0, 0}, 1.0f, 8, 12);
    inside.turnInsideOut();
    EXPECT_FALSE(isClosed(inside.positions, inside.indices)) << "a room seen from inside";
    TestMesh two = ball({10, 0, 0}, 3.0f, 8, 12);
    EXPECT_TRUE(isClosed(two.positions, two.indices));
    TestMesh outer = two;
    two.append(inside);
    EXPECT_FALSE(isClosed(two.positions, two.indices)) << "the volumes add up to more than 0";
    outer.append(ball({0, 0, 0}, 1.0f, 8, 12));
    EXPECT_TRUE(isClosed(outer.positions, outer.indices));
}

TEST(Closed, AnEdgeOfFourTrianglesIsNoBoundary) {
    // Two tetrahedra that share an edge.
    const auto tetrahedron = [](const glm::vec3& tip) {
        TestMesh mesh;
        mesh.positions = {{0, 0, 0}, {0, 1, 0}, tip, tip + glm::vec3(0, 0, 1)};
        mesh.indices = {0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3};
        return mesh;
    };
    TestMesh left = tetrahedron({-1, 0, 0}), right = tetrahedron({1, 0, 0});
    if (!isClosed(left.positions, left.indices)) left.turnInsideOut();
    if (!isClosed(right.positions, right.indices)) right.turnInsideOut();
    ASSERT_TRUE(isClosed(left.positions, left.indices) && isClosed(right.positions, right.indices));
    left.append(right);
    EXPECT_FALSE(isClosed(left.positions, left.indices));
}

double areaOf(const std::vector<glm::dvec2>& points, const IndexPolygon& polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = points[polygon[i]], b = points[polygon[(i + 1) % polygon.size()]];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

/// A grid of n x n squares of two triangles each.
void makeGrid(std::uint32_t n, std::vector<glm::dvec2>& points, std::vector<Triple>& triangles) {
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) points.emplace_back(x, y);
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + 1, d = a + n + 1, c = d + 1;
            triangles.push_back({a, b, c});
            triangles.push_back({a, c, d});
        }
    }
}

TEST(ConvexMerge, AGridBecomesOneRectangle) {
    std::vector<glm::dvec2> points;
    std::vector<Triple> triangles;
    makeGrid(4, points, triangles);
    const auto polygons = mergeConvex(points, triangles, 8);
    ASSERT_EQ(polygons.size(), 1u);
    EXPECT_EQ(polygons[0].size(), 4u);
    EXPECT_DOUBLE_EQ(areaOf(points, polygons[0]), 16.0);
}

TEST(ConvexMerge, ADiskBecomesPiecesOfAtMostEightCornersOfTheSameArea) {
    std::vector<glm::dvec2> points = {{0, 0}};
    std::vector<Triple> triangles;
    const std::uint32_t sides = 64;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 6.283185307179586 * i / sides;
        points.emplace_back(std::cos(angle), std::sin(angle));
        triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
    }
    double area = 0.0;
    const auto polygons = mergeConvex(points, triangles, 8);
    for (const IndexPolygon& polygon : polygons) {
        EXPECT_LE(polygon.size(), 8u);
        EXPECT_GT(areaOf(points, polygon), 0.0);
        area += areaOf(points, polygon);
    }
    EXPECT_LT(polygons.size(), 16u);
    EXPECT_NEAR(area, 0.5 * sides * std::sin(6.283185307179586 / sides), 1e-12);
}

TEST(ConvexMerge, AnAngleStaysTwoPieces) {
    // An L of three squares.
    const std::vector<glm::dvec2> points = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};
    const std::vector<Triple> triangles = {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {5, 4, 7}, {5, 7, 6}};
    const auto polygons = mergeConvex(points, triangles, 8);
    ASSERT_EQ(polygons.size(), 2u);
    EXPECT_DOUBLE_EQ(areaOf(points, polygons[0]) + areaOf(points, polygons[1]), 3.0);
    for (const IndexPolygon& polygon : polygons) EXPECT_EQ(polygon.size(), 4u);
}

}  // namespace
}  // namespace penumbra
