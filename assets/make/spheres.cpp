// Spheres that rest on a plane and spheres that float above it: the shadow tells which is which.
#include <string>

#include "assets/make/scenes.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {

GlbWriter makeSpheres() {
    GlbWriter scene("spheres");
    scene.camera("camera", looking({0.4, 2.5, 6.2}, {0.1, 0.75, 0.0}), 36.0, 0.1, 40.0);
    scene.sun("sun", {0.55, -0.75, -0.35}, {3.2, 2.9, 2.4});
    scene.point("lamp", {2.4, 2.6, 2.2}, {9.0, 8.0, 6.0});
    const int glow = scene.material({.name = "light", .colour = Vec3(0.0), .radiance = {9.0, 9.5, 10.0}});
    scene.add("area light",
              {openQuad({-2.4, 2.6, -0.5}, {-1.4, 2.6, -0.5}, {-1.4, 2.6, 0.5}, {-2.4, 2.6, 0.5}), glow, 0.0,
               Surface::open});

    const int floor = scene.material({.name = "floor", .colour = {0.6, 0.58, 0.54}, .roughness = 0.9});
    scene.add("floor", {box({-6.0, -0.25, -6.0}, {6.0, 0.0, 6.0}), floor});

    struct Ball {
        Vec3 centre;
        double radius;
        Vec3 colour;
        double roughness;
    };
    // The first four rest on the floor (centre.y = radius), the others float.
    const Ball balls[] = {
        {{0.9, 1.0, -0.8}, 1.0, {0.62, 0.3, 0.14}, 0.7},   {{-1.3, 0.5, 0.0}, 0.5, {0.2, 0.42, 0.5}, 0.4},
        {{-0.3, 0.25, 1.0}, 0.25, {0.7, 0.56, 0.2}, 0.3},  {{1.6, 0.15, 1.1}, 0.15, {0.55, 0.16, 0.16}, 0.5},
        {{-0.5, 1.75, -0.2}, 0.3, {0.34, 0.5, 0.24}, 0.5}, {{0.75, 0.6, 1.2}, 0.12, {0.6, 0.58, 0.66}, 0.25},
        {{-2.1, 1.2, 0.8}, 0.18, {0.6, 0.4, 0.5}, 0.6}};
    int number = 0;
    for (const Ball& ball : balls) {
        const std::string name = "ball " + std::to_string(++number);
        const int paint = scene.material({.name = name, .colour = ball.colour, .roughness = ball.roughness});
        const int detail = ball.radius > 0.4 ? 4 : 3;
        scene.add(name, {sphere(ball.radius, detail), paint, 60.0}, at(ball.centre));
    }
    scene.extras(
        R"({"note": "balls 1 to 4 rest on y = 0, balls 5 to 7 float; each is an inscribed icosphere"})");
    return scene;
}

}  // namespace penumbra::assets
