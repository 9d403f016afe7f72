#include <array>

#include "assets/make/courtyard.h"
#include "assets/make/foliage.h"
#include "assets/make/masonry.h"

namespace penumbra::assets {
namespace {

struct Greens {
    int bark, leaves, blades, ivy, terracotta, soil, stone;
};

void addTree(GlbWriter& scene, const Greens& greens) {
    Random random(11);
    const Tree tree = growTree(random, 5.2, 0.15);
    const int place = scene.group("tree", at({-3.0, 0.0, -4.1}));
    scene.add(
        "ring",
        {lathe({{0.0, 0.0}, {0.85, 0.0}, {0.85, 0.3}, {0.82, 0.34}, {0.68, 0.34}, {0.68, 0.24}, {0.0, 0.26}},
               32),
         greens.stone, 40.0},
        {}, place);
    const int crown = scene.group("crown", at({0.0, 0.24, 0.0}), place);
    scene.add("wood", {tree.wood, greens.bark, 70.0}, {}, crown);
    std::array<int, 4> tufts{};
    for (int& tuft : tufts)
        tuft =
            scene.mesh("leaves", {{leafCluster(random, 19, 0.27, 0.13), greens.leaves, 0.0, Surface::open}});
    for (std::size_t i = 0; i < tree.tufts.size(); ++i)
        scene.placeByMatrix("tuft", tufts[i % tufts.size()], tree.tufts[i], crown);
}

void addPots(GlbWriter& scene, const Greens& greens) {
    Random random(23);
    const int pot = scene.mesh("pot", {{assets::pot(0.42, 0.26), greens.terracotta, 35.0}});
    const int agave =
        scene.mesh("agave", {{bladePlant(random, 42, 0.75, 0.07), greens.blades, 0.0, Surface::open}});
    const int bush =
        scene.mesh("bush", {{leafCluster(random, 150, 0.3, 0.11), greens.leaves, 0.0, Surface::open}});
    struct Place {
        Vec3 position;
        double turn, scale;
        bool isAgave;
    };
    const Place places[] = {{{-2.55, 0.0, 3.0}, 20.0, 1.25, true},  {{-3.35, 0.0, 2.4}, 80.0, 0.95, false},
                            {{3.6, 0.0, -1.6}, 40.0, 1.0, false},   {{3.75, 0.0, -2.6}, 150.0, 0.9, true},
                            {{3.6, 0.0, -3.7}, 200.0, 1.05, false}, {{5.35, 0.0, 0.7}, 250.0, 1.15, true},
                            {{-5.3, 0.0, -6.9}, 250.0, 1.1, false}, {{2.4, 0.0, -7.1}, 10.0, 1.0, true}};
    for (const Place& p : places) {
        const int group = scene.group("potted plant", turned(p.position, p.turn, {0, 1, 0}, p.scale));
        scene.place("pot", pot, {}, group);
        scene.place("plant", p.isAgave ? agave : bush, at({0.0, p.isAgave ? 0.38 : 0.6, 0.0}), group);
    }
}

void addIvy(GlbWriter& scene, const Greens& greens) {
    Random random(31);
    Mesh stems, leaves;
    growIvy(random,
            {{0.2, 0.0, 0.02}, {0.0, 1.2, 0.02}, {0.5, 2.6, 0.02}, {0.3, 4.2, 0.02}, {0.9, 5.4, 0.02}}, 0.13,
            1.0, 620, stems, leaves);
    growIvy(random, {{0.2, 0.0, 0.02}, {-0.7, 1.4, 0.02}, {-1.1, 2.9, 0.02}, {-0.8, 4.6, 0.02}}, 0.12, 0.8,
            380, stems, leaves);
    // On the sunny face of the wall beside the stairs, which looks along -x.
    const int wall = scene.group("ivy", turned({5.9, 0.0, 2.1}, -90.0));
    scene.add("stems", {stems, greens.bark, 70.0}, {}, wall);
    scene.add("leaves", {leaves, greens.ivy, 0.0, Surface::open}, {}, wall);
}

}  // namespace

void addGarden(GlbWriter& scene) {
    const Greens greens{
        scene.material({.name = "bark", .colour = {0.3, 0.22, 0.15}, .roughness = 0.95}),
        scene.material({.name = "leaf", .colour = {0.23, 0.33, 0.09}, .roughness = 0.5, .doubleSided = true}),
        scene.material({.name = "blade", .colour = {0.2, 0.33, 0.2}, .roughness = 0.45, .doubleSided = true}),
        scene.material({.name = "ivy", .colour = {0.15, 0.26, 0.07}, .roughness = 0.5, .doubleSided = true}),
        scene.material({.name = "terracotta", .colour = {0.58, 0.27, 0.15}, .roughness = 0.8}),
        scene.material({.name = "soil", .colour = {0.14, 0.1, 0.07}, .roughness = 1.0}),
        scene.material({.name = "ring stone", .colour = {0.55, 0.5, 0.42}, .roughness = 0.85})};
    addTree(scene, greens);
    addPots(scene, greens);
    addIvy(scene, greens);
}

}  // namespace penumbra::assets
