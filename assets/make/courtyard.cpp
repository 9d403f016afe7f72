// The default scene: a cloister in the evening. Arches, stairs, a tree, a statue, railings, and things that
// touch.
#include "assets/make/courtyard.h"

#include "assets/make/masonry.h"
#include "assets/make/scenes.h"

namespace penumbra::assets {

void addGround(GlbWriter& scene) {
    const int mortar = scene.material({.name = "mortar", .colour = {0.3, 0.26, 0.21}, .roughness = 0.95});
    scene.add("mortar", {box({-13.0, -0.4, -12.0}, {8.0, -0.012, 9.0}), mortar});
    const Vec3 tints[] = {{0.56, 0.47, 0.37}, {0.5, 0.43, 0.35}, {0.6, 0.51, 0.4}, {0.47, 0.4, 0.34}};
    Random random(3);
    const std::vector<Mesh> stones = paving(random, {-8.5, -11.2}, {6.2, 8.5}, 4);
    for (std::size_t i = 0; i < stones.size(); ++i) {
        const int stone =
            scene.material({.name = "paving", .colour = tints[i], .roughness = 0.7 + 0.06 * double(i)});
        scene.add("paving stones", {stones[i], stone});
    }
}

GlbWriter makeCourtyard() {
    GlbWriter scene("courtyard");
    scene.camera("camera", looking({-1.3, 2.05, 8.7}, {0.55, 1.75, -4.0}), 44.0, 0.1, 60.0);
    scene.camera("from the landing", looking({4.6, 4.1, -5.4}, {-2.6, 0.2, 0.6}), 55.0, 0.1, 60.0);
    scene.sun("low sun", {0.8, -0.52, -0.42}, {4.1, 3.1, 2.0});
    scene.point("lantern", lanternLight, {9.0, 6.4, 3.4});
    addGround(scene);
    addCloister(scene);
    addStairWing(scene);
    addFountain(scene);
    addGarden(scene);
    addFurniture(scene);
    return scene;
}

}  // namespace penumbra::assets
