// Lecture figure 2 (Heckbert & Herf 1997): one square light, one triangle, one rectangle.
#include "assets/make/scenes.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {
namespace {

// The closed-form values are stated with z up; the file has Y up.
Vec3 fromZUp(double x, double y, double z) {
    return {x, z, -y + 0.0};
}

Mesh rectangle(double half, double height, bool facingUp) {
    const Vec3 a = fromZUp(-half, -half, height), b = fromZUp(half, -half, height);
    const Vec3 c = fromZUp(half, half, height), d = fromZUp(-half, half, height);
    return facingUp ? openQuad(a, b, c, d) : openQuad(a, d, c, b);
}

}  // namespace

GlbWriter makeHeckbertHerf() {
    GlbWriter scene("Heckbert and Herf's scene");
    scene.camera("camera", looking({1.55, 1.5, 3.4}, {0.02, 0.76, 0.0}), 54.0, 0.1, 20.0);
    // Exactly what lies on the receiver, undistorted: just below the triangle, looking straight down.
    scene.orthographicCamera("receiver", looking({0.0, 0.9, 0.0}, {0.0, 0.0, 0.0}), 2.4, 0.05, 2.0);

    const int light = scene.material({.name = "light", .colour = Vec3(0.0), .radiance = Vec3(8.0)});
    const int paper = scene.material({.name = "receiver", .colour = {0.75, 0.74, 0.7}, .doubleSided = true});
    const int card = scene.material({.name = "triangle", .colour = {0.7, 0.22, 0.12}, .doubleSided = true});

    scene.add("light", {rectangle(0.5, 2.0, false), light, 0.0, Surface::open});
    scene.add("receiver", {rectangle(1.2, 0.0, true), paper, 0.0, Surface::open});
    Mesh triangle;
    triangle.triangle(fromZUp(-0.4, -0.35, 1.0), fromZUp(0.45, -0.3, 1.0), fromZUp(0.0, 0.45, 1.0));
    scene.add("triangle", {triangle, card, 0.0, Surface::open});
    scene.extras(R"({"note": "A scene stated with z up, mapped by (x, y, z) -> (x, z, -y).",
        "light": {"square": 1.0, "height": 2.0, "radiance": 8.0},
        "triangle": [[-0.4, -0.35, 1.0], [0.45, -0.3, 1.0], [0.0, 0.45, 1.0]],
        "receiver": {"square": 2.4, "height": 0.0}})");
    return scene;
}

}  // namespace penumbra::assets
