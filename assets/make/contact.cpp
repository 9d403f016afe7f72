// Things that touch: a wall, a box, a post and a plank, all with their lowest points at exactly y = 0. The
// first light stands behind the wall, so a bias that is too large shows as a bright line along its foot.
#include "assets/make/contact.h"
#include "assets/make/scenes.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {
namespace {

// Leans against the plane x = 0.2 with slope 4 : 3, so that foot and head touch exactly.
Mesh leaningPlank() {
    const Vec2 foot(1.4, 0.0), head(0.2, 1.6), thickness(0.04, 0.03);
    return extrude({foot, foot + thickness, head + thickness, head}, -1.3, -1.0);
}

}  // namespace

void addContactCamera(GlbWriter& scene) {
    scene.camera("camera", looking({0.9, 2.5, 5.9}, {0.0, 0.66, -0.3}), 38.0, 0.1, 40.0);
}

void addContactThings(GlbWriter& scene) {
    const int floor = scene.material({.name = "floor", .colour = {0.62, 0.6, 0.56}, .roughness = 0.9});
    const int plaster = scene.material({.name = "plaster", .colour = {0.66, 0.5, 0.36}, .roughness = 0.95});
    const int wood = scene.material({.name = "wood", .colour = {0.5, 0.29, 0.14}, .roughness = 0.6});
    const int paint = scene.material({.name = "paint", .colour = {0.16, 0.32, 0.46}, .roughness = 0.4});
    const int iron = scene.material({.name = "iron", .colour = {0.18, 0.18, 0.2}, .roughness = 0.35});

    scene.add("floor", {box({-6.0, -0.25, -6.0}, {6.0, 0.0, 6.0}), floor});
    scene.add("wall", {box({-1.2, 0.0, -1.4}, {0.2, 1.9, -1.2}), plaster});
    scene.add("box", {box({-0.4, 0.0, -0.4}, {0.4, 0.8, 0.4}), paint}, turned({-1.35, 0.0, 0.55}, 28.0));
    scene.add("plank", {leaningPlank(), wood});
    scene.add("post", {bar({0.0, 0.0, 0.0}, {0.0, 1.7, 0.0}, 0.03, 12), iron, 60.0}, at({-0.15, 0.0, 0.75}));
    scene.extras(R"({"note": "wall, box, plank and post stand on y = 0 without a gap"})");
}

GlbWriter makeContact() {
    GlbWriter scene("contact");
    addContactCamera(scene);
    scene.spot("lamp behind the wall", looking({-3.2, 3.4, -4.2}, {0.2, 0.2, 0.0}), {110.0, 98.0, 80.0}, 25.0,
               38.0);
    scene.point("lamp in front", {2.6, 2.2, 2.8}, {8.0, 9.0, 11.0});
    addContactThings(scene);
    return scene;
}

}  // namespace penumbra::assets
