// Occluders thinner than a shadow filter is wide: netting, taut wires, railings, ivy. A filter that probes a
// few taps and trusts them misses these.
#include "assets/make/foliage.h"
#include "assets/make/ironwork.h"
#include "assets/make/scenes.h"

namespace penumbra::assets {
namespace {

void addNetting(GlbWriter& scene, int iron) {
    constexpr double pitch = 0.075, height = 1.2;
    constexpr int wires = 32;
    const int even = scene.mesh("net wire, even", {{netWire(height, pitch, 0.0022, true), iron, 60.0}});
    const int odd = scene.mesh("net wire, odd", {{netWire(height, pitch, 0.0022, false), iron, 60.0}});
    const int net = scene.group("netting", turned({-2.55, 0.06, 0.35}, 12.0));
    for (int i = 0; i < wires; ++i)
        scene.place("wire", i % 2 == 0 ? even : odd, at({(i + 0.5) * pitch, 0.0, 0.0}), net);
    const int post = scene.mesh("net post", {{bar({0, -0.06, 0}, {0, 1.24, 0}, 0.022, 10), iron, 60.0}});
    scene.place("post", post, at({-0.03, 0.0, 0.0}), net);
    scene.place("post", post, at({wires * pitch + 0.03, 0.0, 0.0}), net);
}

void addWires(GlbWriter& scene, int iron) {
    Mesh wires;
    // From 6 mm down to 0.5 mm thick.
    const double radii[] = {0.003, 0.0015, 0.0008, 0.0004, 0.00025};
    for (int i = 0; i < 5; ++i) {
        const double y = 0.25 + 0.22 * i;
        wires.append(bar({0.15, y, 0.75}, {2.45, y, 0.25}, radii[i], 6));
    }
    wires.append(bar({0.15, 0.0, 0.75}, {0.15, 1.3, 0.75}, 0.025, 10));
    wires.append(bar({2.45, 0.0, 0.25}, {2.45, 1.3, 0.25}, 0.025, 10));
    scene.add("taut wires", {wires, iron, 60.0});
}

void addIvy(GlbWriter& scene, int wood, int green) {
    Random random(7);
    Mesh stems, leaves;
    growIvy(random, {{0.9, 0.0, 0.01}, {1.0, 0.6, 0.01}, {0.75, 1.1, 0.01}, {1.0, 2.3, 0.01}}, 0.07, 0.5, 260,
            stems, leaves);
    growIvy(random, {{1.0, 0.0, 0.01}, {1.3, 0.5, 0.01}, {1.7, 0.9, 0.01}, {1.8, 2.0, 0.01}}, 0.06, 0.4, 220,
            stems, leaves);
    const int parent = scene.group("ivy", at({0.0, 0.0, -1.2}));
    scene.add("stems", {stems, wood, 70.0}, {}, parent);
    scene.add("leaves", {leaves, green, 0.0, Surface::open}, {}, parent);
}

}  // namespace

GlbWriter makeFence() {
    GlbWriter scene("fence");
    scene.camera("camera", looking({0.35, 1.8, 5.0}, {-0.02, 0.62, -0.35}), 42.0, 0.05, 40.0);
    scene.sun("sun", {0.42, -0.72, -0.68}, {3.2, 2.9, 2.4});
    scene.point("lamp", {0.3, 2.0, 1.9}, {6.0, 5.2, 4.0});

    const int floor = scene.material({.name = "gravel", .colour = {0.58, 0.54, 0.47}, .roughness = 0.95});
    const int plaster = scene.material({.name = "plaster", .colour = {0.68, 0.58, 0.46}, .roughness = 0.95});
    const int iron = scene.material({.name = "iron", .colour = {0.16, 0.17, 0.19}, .roughness = 0.4});
    const int wood = scene.material({.name = "stem", .colour = {0.26, 0.17, 0.1}, .roughness = 0.9});
    const int green =
        scene.material({.name = "ivy", .colour = {0.14, 0.3, 0.08}, .roughness = 0.55, .doubleSided = true});

    scene.add("ground", {box({-5.0, -0.25, -4.0}, {5.0, 0.0, 6.0}), floor});
    scene.add("wall", {box({-5.0, 0.0, -1.45}, {5.0, 3.4, -1.2}), plaster});
    addNetting(scene, iron);
    addWires(scene, iron);
    scene.add("railing", {railing(2.4, 0.9, 0.11, 0.008), iron, 60.0}, turned({-2.4, 0.0, -0.62}, 0.0));
    addIvy(scene, wood, green);
    return scene;
}

}  // namespace penumbra::assets
