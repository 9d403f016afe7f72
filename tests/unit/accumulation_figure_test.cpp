// Heckbert & Herf's scene, the whole way from its file: the receivers found in it, and their exact light.
#include <gtest/gtest.h>

#include <numbers>

#include "chapters/08_accumulation/exact_receiver.h"
#include "common/scene/find_scene.h"
#include "common/scene/gltf_loader.h"
#include "common/truth/exact_scene.h"

namespace penumbra {
namespace {

using glm::dvec3;

TEST(AccumulationFigure, ItsReceivers) {
    const Scene scene = loadGltf(findScene("heckbert_herf"));
    ReceiverRequest request;
    request.texelsPerMetre = 512 / 2.4;
    const std::vector<Receiver> receivers = findReceivers(scene, request);
    ASSERT_EQ(receivers.size(), 2u);  // the floor and the top of the triangle; the light has none
    const Receiver& floor = receivers[0];
    EXPECT_EQ(scene.parts[std::size_t(floor.part)].name, "receiver");
    EXPECT_NEAR(floor.area, 5.76, 1e-6);
    EXPECT_EQ(floor.texels, glm::ivec2(512));
    EXPECT_FALSE(floor.back);
    EXPECT_EQ(floor.normal, dvec3(0, 1, 0));
    EXPECT_EQ(floor.triangles.size(), 2u);
    for (int i = 0; i < 4; ++i) {
        const dvec3 corner = floor.at({i & 1, i >> 1});
        EXPECT_EQ(std::abs(corner.x), double(1.2f));
        EXPECT_EQ(std::abs(corner.z), double(1.2f));
        EXPECT_EQ(corner.y, 0.0);
    }
    EXPECT_EQ(scene.parts[std::size_t(receivers[1].part)].name, "triangle");
    EXPECT_GT(receivers[1].normal.y, 0.999);
    EXPECT_GE(glm::length(glm::cross(receivers[1].uEdge, receivers[1].vEdge)), receivers[1].area);
}

// The loader's floats, its part for the light, Y up: the whole way from a file.
TEST(AccumulationFigure, ItsExactIrradiance) {
    const Scene scene = loadGltf(findScene("heckbert_herf"));
    ReceiverRequest request;
    request.texelsPerMetre = 128 / 2.4;
    const Receiver floor = findReceivers(scene, request)[0];
    const Light& light = scene.lights[0];
    const Occluders occluders = occludersBetween(scene, floor, light);
    const ExactIrradiance exact = exactIrradiance(floor, light, occluders.reaching);
    const ExactScene truth(scene);
    for (int row = 0; row < 128; ++row)
        for (int column = 0; column < 128; ++column) {
            const double expected = truth.visibleFormFactor(floor.texelCentre(column, row), floor.normal,
                                                            light.polygons[0], light.part);
            EXPECT_NEAR(exact.values[128 * std::size_t(row) + std::size_t(column)] / std::numbers::pi,
                        expected, 1e-15);
        }
}

}  // namespace
}  // namespace penumbra
