// Which polygons of a scene become receivers, and what their textures cover.
#include "chapters/08_accumulation/receiver.h"

#include <gtest/gtest.h>

#include <array>

#include "chapters/08_accumulation/flat_polygons.h"
#include "tests/unit/accumulation_scenes.h"

namespace penumbra {
namespace {

using namespace accumulation_scenes;
using test_meshes::addBox;
using test_meshes::addQuad;
using test_meshes::addSphere;
using test_meshes::scaledAndMoved;

/// A scene with a light above that faces down, and nothing else yet.
Scene sceneWithLight(const Light& light = squareLight()) {
    Scene scene = test_meshes::emptyScene();
    scene.lights = {light};
    return scene;
}

double distance(const dvec3& a, const dvec3& b) {
    return glm::length(a - b);
}

/// Smallest and largest (u, v) of the receiver's triangles.
std::array<glm::dvec2, 2> covered(const Scene& scene, const Receiver& receiver) {
    glm::dvec2 lower(1e9), upper(-1e9);
    for (const std::uint32_t t : receiver.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 uv = receiver.uv(scene.positions[scene.indices[3 * std::size_t(t) + k]]);
            lower = glm::min(lower, uv);
            upper = glm::max(upper, uv);
        }
    return {lower, upper};
}

TEST(AccumulationReceiver, TexelCentresAndTheirInverse) {
    const Receiver skewed = receiverOn({1, 2, 3}, {2, 0, 0}, {0.7, 1.5, 0.4}, {7, 5});
    EXPECT_EQ(skewed.texelCentre(0, 0), skewed.at({0.5 / 7, 0.5 / 5}));
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 7; ++column) {
            const glm::dvec2 uv = skewed.uv(skewed.texelCentre(column, row) + 0.3 * skewed.normal);
            EXPECT_NEAR(uv.x * 7, column + 0.5, 1e-14);
            EXPECT_NEAR(uv.y * 5, row + 0.5, 1e-14);
        }
    EXPECT_NEAR(skewed.height(skewed.at({0.2, 0.7}) - 0.25 * skewed.normal), -0.25, 1e-15);
}

TEST(AccumulationReceiver, ParallelogramsAreTheirOwn) {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const Receiver made = random.receiver({1, 1});
        std::vector<dvec3> points;
        for (int i = 0; i < 4; ++i) points.push_back(made.at({i & 1, i >> 1}));
        points.push_back(made.at({0.5, 0.0}));  // in the middle of a side, and inside
        points.push_back(made.at({0.3, 0.6}));
        const auto [corner, u, v] = parallelogramAround(points, made.normal);
        EXPECT_NEAR(glm::length(glm::cross(u, v)), made.area, 1e-12);
        EXPECT_GT(glm::dot(glm::cross(u, v), made.normal), 0.0);
        for (int i = 0; i < 4; ++i) {
            const dvec3 p = corner + double(i & 1) * u + double(i >> 1) * v;
            double nearest = 1e9;
            for (int k = 0; k < 4; ++k) nearest = std::min(nearest, distance(p, points[std::size_t(k)]));
            EXPECT_LT(nearest, 1e-14);
        }
    }
}

TEST(AccumulationReceiver, SmallestRectangleAroundAnythingElse) {
    // An L of a 3 x 2 box without a 1 x 1 corner, turned: its box is 3 x 2.
    const double a = 0.4;
    const auto turned = [&](double x, double y) {
        return dvec3(std::cos(a) * x - std::sin(a) * y, std::sin(a) * x + std::cos(a) * y, 1.0);
    };
    const std::vector<dvec3> l = {turned(0, 0), turned(3, 0), turned(3, 1),
                                  turned(2, 1), turned(2, 2), turned(0, 2)};
    const auto [corner, u, v] = parallelogramAround(l, dvec3(0, 0, 1));
    EXPECT_NEAR(glm::length(u) * glm::length(v), 6.0, 1e-12);
    EXPECT_NEAR(glm::dot(u, v), 0.0, 1e-12);
    const Receiver box = receiverOn(corner, u, v, {1, 1});
    for (const dvec3& p : l) {
        EXPECT_GE(std::min(box.uv(p).x, box.uv(p).y), -1e-12);
        EXPECT_LE(std::max(box.uv(p).x, box.uv(p).y), 1.0 + 1e-12);
    }
    // A thin diagonal bar: not its axis-aligned box.
    const std::vector<dvec3> bar = {turned(0, 0), turned(5, 0), turned(5.05, 0.05), turned(5, 0.1),
                                    turned(0, 0.1)};
    const auto around = parallelogramAround(bar, dvec3(0, 0, 1));
    EXPECT_NEAR(glm::length(glm::cross(around[1], around[2])), 5.05 * 0.1, 1e-12);
}

TEST(AccumulationReceiver, NoTurnedBoxIsSmaller) {
    Random random(7);
    for (int trial = 0; trial < 200; ++trial) {
        const std::vector<dvec3> outline = random.polygon(dvec3(0.0), dvec3(0, 0, 1), 1.0);
        const auto [corner, u, v] = parallelogramAround(outline, dvec3(0, 0, 1));
        for (double angle = 0.0; angle < 1.58; angle += 0.01) {
            const dvec3 right(std::cos(angle), std::sin(angle), 0.0), up(-right.y, right.x, 0.0);
            glm::dvec2 lower(1e9), upper(-1e9);
            for (const dvec3& p : outline) {
                lower = glm::min(lower, glm::dvec2(glm::dot(right, p), glm::dot(up, p)));
                upper = glm::max(upper, glm::dvec2(glm::dot(right, p), glm::dot(up, p)));
            }
            const double area = (upper.x - lower.x) * (upper.y - lower.y);
            EXPECT_LE(glm::length(glm::cross(u, v)), area * (1.0 + 1e-9)) << trial;
        }
    }
}

/// n x n squares on [-1,1]^2 at height z, with vertices of their own; from the right by a slope.
void addGrid(Scene& scene, int n, double slope) {
    std::vector<Triangle> triangles;
    const auto at = [&](int i, int j) { return dvec3(-1 + 2.0 * i / n, -1 + 2.0 * j / n, slope * i / n); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    addTriangles(scene, triangles);
}

TEST(AccumulationReceiver, CoplanarTrianglesAreOnePolygon) {
    Scene scene = sceneWithLight();
    addGrid(scene, 12, 0.37);
    const std::vector<Receiver> receivers = findReceivers(scene, {});
    ASSERT_EQ(receivers.size(), 1u);
    EXPECT_EQ(receivers[0].triangles.size(), 288u);
    EXPECT_TRUE(std::is_sorted(receivers[0].triangles.begin(), receivers[0].triangles.end()));
    EXPECT_NEAR(receivers[0].area, 2.0 * std::hypot(2.0, 0.37), 1e-6);
    const auto [lower, upper] = covered(scene, receivers[0]);
    for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(lower[k], 0.0, 1e-6);
        EXPECT_NEAR(upper[k], 1.0, 1e-6);
    }
}

TEST(AccumulationReceiver, ApartFoldedOrInAnotherPartIsAnother) {
    Scene scene = sceneWithLight();
    addTriangles(scene, {{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(1, 1, 0)},
                         {dvec3(0, 0, 0), dvec3(-1, 1, 0.2), dvec3(-1, 0, 0.2)},  // meets in a point, folded
                         {dvec3(2, 0, 0), dvec3(3, 0, 0), dvec3(3, 1, 0)}});      // in the plane, apart
    addTriangles(scene, {{dvec3(0, 0, 0), dvec3(1, 1, 0), dvec3(0, 1, 0)}});      // another part
    EXPECT_EQ(findReceivers(scene, {}).size(), 4u);
    // Folded along an edge, even if the file says that its normals are those of the plane.
    Scene folded = sceneWithLight();
    addTriangles(folded, {{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(1, 1, 0)},
                          {dvec3(0, 0, 0), dvec3(1, 1, 0), dvec3(0, 1, 0.1)}});
    std::fill(folded.normals.begin(), folded.normals.end(), glm::vec3(0, 0, 1));
    ASSERT_EQ(findReceivers(folded, {}).size(), 1u);
    EXPECT_EQ(findReceivers(folded, {})[0].triangles.size(), 1u);
    // Within one part the last would be one with the first.
    Scene joined = sceneWithLight();
    addTriangles(joined, {{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(1, 1, 0)},
                          {dvec3(0, 0, 0), dvec3(1, 1, 0), dvec3(0, 1, 0)}});
    EXPECT_EQ(findReceivers(joined, {}).size(), 1u);
}

TEST(AccumulationReceiver, CurvedSurfacesHaveNone) {
    Scene scene = sceneWithLight();
    addSphere(scene, 1, scaledAndMoved(1.0, 0.0));  // faces of 0.1 m^2, smooth normals
    EXPECT_TRUE(findReceivers(scene, {}).empty());
}

TEST(AccumulationReceiver, SmallAndDegenerateOnesHaveNone) {
    Scene scene = sceneWithLight();
    addTriangles(scene, {{dvec3(0, 0, 0), dvec3(0.3, 0, 0), dvec3(0, 0.3, 0)}});
    ReceiverRequest request;
    request.minimumArea = 0.0449;
    EXPECT_EQ(findReceivers(scene, request).size(), 1u);
    request.minimumArea = 0.0451;
    EXPECT_TRUE(findReceivers(scene, request).empty());
    addTriangles(scene, {{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(1, 0, 0)},
                         {dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(2, 0, 0)}});
    request.minimumArea = 0.0;
    EXPECT_EQ(findReceivers(scene, request).size(), 1u);
}

TEST(AccumulationReceiver, EachSideThatLightReaches) {
    // A wall that the light straddles: both sides; a floor below it: its upper side; seen from the back too.
    Scene wall = sceneWithLight();
    addQuad(wall, {0, -1, 0}, {0, 1, 0}, {0, 1, 1}, {0, -1, 1});
    const std::vector<Receiver> sides = findReceivers(wall, {});
    ASSERT_EQ(sides.size(), 2u);
    EXPECT_GT(sides[0].normal.x, 0.999);
    EXPECT_LT(sides[1].normal.x, -0.999);
    EXPECT_FALSE(sides[0].back);
    EXPECT_TRUE(sides[1].back);

    Scene turned = sceneWithLight();
    addQuad(turned, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0});  // clockwise from above
    const std::vector<Receiver> floor = findReceivers(turned, {});
    ASSERT_EQ(floor.size(), 1u);
    EXPECT_TRUE(floor[0].back);
    EXPECT_GT(floor[0].normal.z, 0.999);

    Scene above = sceneWithLight();  // behind the light: nothing
    addQuad(above, {-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3});
    EXPECT_TRUE(findReceivers(above, {}).empty());
}

TEST(AccumulationReceiver, InsidesAndLightsHaveNone) {
    Scene scene = sceneWithLight();
    addBox(scene, scaledAndMoved(1.0, 0.0));
    // A box of shared vertices has smooth normals; give every face its own.
    Scene box = sceneWithLight();
    for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
        Triangle t;
        for (std::size_t k = 0; k < 3; ++k) t[k] = scene.positions[scene.indices[i + k]];
        addTriangles(box, {t});
    }
    Part whole = box.parts[0];
    whole.triangleCount = 12;
    whole.bounds = scene.parts[0].bounds;
    box.parts = {whole};
    // The light is as wide as the box: it arrives at the top, and from inside at the bottom and the sides.
    EXPECT_EQ(findReceivers(box, {}).size(), 6u);
    box.lights = {areaLight({{-2, -2, 2}, {-2, 2, 2}, {2, 2, 2}, {2, -2, 2}})};
    const std::size_t open = findReceivers(box, {}).size();
    box.parts[0].closed = true;
    EXPECT_EQ(findReceivers(box, {}).size(), 5u);  // the top and four sides
    EXPECT_EQ(open, 10u);                          // and from inside the bottom and the sides
    box.lights[0].part = 0;
    EXPECT_TRUE(findReceivers(box, {}).empty());
}

TEST(AccumulationReceiver, OnlyTheLightsAskedFor) {
    Scene scene = sceneWithLight();
    scene.lights.push_back(areaLight({{-0.5, -0.5, -2}, {0.5, -0.5, -2}, {0.5, 0.5, -2}, {-0.5, 0.5, -2}}));
    addQuad(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    EXPECT_EQ(findReceivers(scene, {}).size(), 2u);
    ReceiverRequest request;
    request.lights = {1};
    const std::vector<Receiver> below = findReceivers(scene, request);
    ASSERT_EQ(below.size(), 1u);
    EXPECT_LT(below[0].normal.z, -0.999);
}

TEST(AccumulationReceiver, LightsWithoutAnArea) {
    const Receiver floor = figureReceiver(4);
    Light sun;
    sun.direction = {0, 0, -1};
    EXPECT_TRUE(receives(floor, sun));
    sun.direction = {1, 0, 0};
    EXPECT_FALSE(receives(floor, sun));
    Light lamp;
    lamp.type = LightType::point;
    lamp.position = {5, 0, 1};
    EXPECT_TRUE(receives(floor, lamp));
    lamp.position.z = 0;  // in the plane
    EXPECT_FALSE(receives(floor, lamp));
}

TEST(AccumulationReceiver, LargestFirstWithinTheBudget) {
    Scene scene = sceneWithLight();
    addQuad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    addQuad(scene, {2, 0, 0}, {5, 0, 0}, {5, 2, 0}, {2, 2, 0});
    ReceiverRequest request;
    std::vector<Receiver> receivers = findReceivers(scene, request);
    ASSERT_EQ(receivers.size(), 2u);
    EXPECT_NEAR(receivers[0].area, 6.0, 1e-6);
    EXPECT_EQ(receivers[0].texels.x * receivers[0].texels.y, 60000);
    EXPECT_EQ(receivers[1].texels, glm::ivec2(100));
    request.budget = 7000;  // a tenth of the texels: about a third of the density, the same on both
    receivers = findReceivers(scene, request);
    EXPECT_LE(texelCount(receivers), 7000);
    EXPECT_GT(texelCount(receivers), 6500);
    const int longer = std::max(receivers[0].texels.x, receivers[0].texels.y);
    EXPECT_NEAR(double(longer) / receivers[1].texels.x, 3.0, 0.1);
    request.maximumSide = 50;
    receivers = findReceivers(scene, request);
    EXPECT_EQ(std::max(receivers[0].texels.x, receivers[0].texels.y), 50);
}

}  // namespace
}  // namespace penumbra
