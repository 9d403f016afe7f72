#include "assets/make/courtyard.h"
#include "assets/make/ironwork.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {
namespace {

Mesh benchWood() {
    Mesh mesh;
    for (int i = 0; i < 5; ++i) mesh.append(box({-0.9, 0.42, -0.22 + 0.1 * i}, {0.9, 0.46, -0.14 + 0.1 * i}));
    for (int i = 0; i < 3; ++i)
        mesh.append(box({-0.9, 0.56 + 0.12 * i, -0.3}, {0.9, 0.65 + 0.12 * i, -0.265}));
    return mesh;
}

Mesh benchIron() {
    Mesh mesh;
    for (const double x : {-0.75, 0.75}) {
        mesh.append(bar({x, 0.0, 0.18}, {x, 0.42, 0.2}, 0.018));
        mesh.append(bar({x, 0.0, -0.3}, {x, 0.92, -0.29}, 0.018));
        mesh.append(bar({x, 0.405, -0.29}, {x, 0.405, 0.24}, 0.016));
    }
    return mesh;
}

Mesh jar() {
    return lathe({{0.0, 0.0},
                  {0.12, 0.0},
                  {0.13, 0.03},
                  {0.11, 0.06},
                  {0.2, 0.22},
                  {0.24, 0.36},
                  {0.22, 0.48},
                  {0.13, 0.58},
                  {0.09, 0.63},
                  {0.09, 0.68},
                  {0.13, 0.72},
                  {0.13, 0.74},
                  {0.09, 0.745},
                  {0.06, 0.72},
                  {0.06, 0.6},
                  {0.0, 0.58}},
                 24);
}

void addLampPost(GlbWriter& scene, int iron) {
    const double x = lanternLight.x, z = lanternLight.z;
    Mesh post = lathe({{0.0, 0.0},
                       {0.16, 0.0},
                       {0.16, 0.08},
                       {0.11, 0.14},
                       {0.07, 0.3},
                       {0.08, 0.34},
                       {0.045, 0.4},
                       {0.035, 1.8},
                       {0.06, 1.84},
                       {0.06, 1.9},
                       {0.11, 1.96},
                       {0.0, 1.96}},
                      12);
    scene.add("lamp post", {post, iron, 40.0}, at({x, 0.0, z}));
    scene.add("lantern", {lantern(0.66), iron, 40.0}, at({x, 2.62, z}));
}

}  // namespace

void addFurniture(GlbWriter& scene) {
    const int iron = scene.material({.name = "cast iron", .colour = {0.08, 0.1, 0.1}, .roughness = 0.4});
    const int wood = scene.material({.name = "bench wood", .colour = {0.42, 0.25, 0.13}, .roughness = 0.6});
    const int clay = scene.material({.name = "clay", .colour = {0.5, 0.3, 0.18}, .roughness = 0.55});
    const int bench = scene.mesh("bench", {{benchWood(), wood}, {benchIron(), iron, 60.0}});
    scene.place("bench", bench, turned({-5.0, 0.0, -5.2}, 60.0));
    scene.place("bench", bench, turned({-1.1, 0.0, -7.15}, 4.0));
    const int jar = scene.mesh("jar", {{assets::jar(), clay, 50.0}});
    scene.place("jar", jar, turned({1.85, 0.0, -1.75}, 30.0));
    scene.place("jar", jar, turned({2.25, 0.0, -2.05}, 80.0, {0, 1, 0}, 0.75));
    addLampPost(scene, iron);
}

}  // namespace penumbra::assets
