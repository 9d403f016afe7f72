#include "tests/stress/closed_body.h"

#include "common/math/hemisphere.h"
#include "common/truth/shadow_packet.h"
#include "tests/unit/test_meshes.h"

namespace penumbra::stress {

Scene closedBody(const Case& given, double flattest, Dice& dice) {
    using namespace test_meshes;
    Scene scene = emptyScene();
    const int kind = dice.below(5);
    const Place asItIs = scaledAndMoved(1.0, 0.0);
    if (kind == 0)
        addPart(scene, {{0, 0, 1}, {0.9, 0, -0.4}, {-0.5, 0.8, -0.4}, {-0.5, -0.8, -0.4}},
                {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2}, asItIs);
    else if (kind == 1)
        addBox(scene, asItIs);
    else
        addSphere(scene, kind - 2, asItIs);
    const glm::dvec3 stretch(1.0, dice.magnitude(flattest, 1.0), dice.magnitude(flattest, 1.0));
    const glm::dmat3 turn = dice.oneIn(3) ? glm::dmat3(1.0) : frameAround(dice.direction());
    const double scale = given.number("scale"), offset = given.number("distance") / std::sqrt(3.0);
    scene.bounds = Aabb();
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const glm::dvec3 p = turn * (stretch * glm::dvec3(scene.positions[i]));
        scene.positions[i] = glm::vec3(scale * p + glm::dvec3(offset));
        scene.bounds.extend(glm::dvec3(scene.positions[i]));
        scene.normals[i] = glm::vec3(glm::normalize(turn * (glm::dvec3(scene.normals[i]) / stretch)));
    }
    scene.parts[0].bounds = scene.bounds;
    return scene;
}

double floatUlp(const Scene& scene) {
    return 0x1p-23 * largestCoordinate(scene.bounds);
}

}  // namespace penumbra::stress
