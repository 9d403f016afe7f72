#include "assets/make/courtyard.h"
#include "assets/make/masonry.h"

namespace penumbra::assets {
namespace {

struct Stone {
    int plaster, trim, tile, wood;
};

// One row of arches in a group of its own: the wall, and a moulding and a column per bay, as instances.
void addArcade(GlbWriter& scene, const Stone& stone, const Arcade& arcade, const Pose& pose) {
    const int row = scene.group("arcade", pose);
    scene.add("arcade wall", {arcadeWall(arcade), stone.plaster, 40.0}, {}, row);
    const int moulding = scene.mesh("arch moulding", {{archMoulding(arcade), stone.trim, 40.0}});
    const int column = scene.mesh("column", {{assets::column(arcade.spring, 0.14), stone.trim, 50.0},
                                             {columnBlocks(arcade.spring, 0.14), stone.trim}});
    for (int i = 0; i < arcade.bays; ++i)
        scene.place("arch moulding", moulding, at({(i + 0.5) * arcade.bay, 0.0, 0.0}), row);
    for (int i = 0; i <= arcade.bays; ++i) scene.place("column", column, at({i * arcade.bay, 0.0, 0.0}), row);
    const double length = arcade.bay * arcade.bays, half = 0.5 * arcade.thickness;
    Mesh cornice = box({-0.1, arcade.top, -half - 0.1}, {length + 0.1, arcade.top + 0.12, half + 0.1});
    cornice.append(
        box({-0.16, arcade.top + 0.12, -half - 0.17}, {length + 0.16, arcade.top + 0.22, half + 0.17}));
    scene.add("cornice", {cornice, stone.trim}, {}, row);
}

void addRoof(GlbWriter& scene, const Stone& stone) {
    const int tile = scene.mesh("tile", {{barrelTile(0.52, 0.17), stone.tile, 50.0}});
    // Local z runs down the slope.
    const int slope = scene.group("roof", turned({-6.3, 3.87, -7.65}, 20.0, {1, 0, 0}));
    scene.add("roof deck", {box({-0.1, -0.08, -3.2}, {12.4, 0.0, 0.1}), stone.wood}, {}, slope);
    for (int column = 0; column < 33; ++column)
        for (int row = 0; row < 7; ++row)
            scene.place("tile", tile, at({0.1 + 0.37 * column, 0.012 * row, -0.43 * row + 0.15}), slope);
}

void addWindow(GlbWriter& scene, const Stone& stone) {
    const int glow = scene.material({.name = "window", .colour = Vec3(0.0), .radiance = {7.0, 4.9, 2.6}});
    const double z = -10.95;
    scene.add("window light", {openQuad({-3.1, 0.75, z}, {-1.7, 0.75, z}, {-1.7, 2.55, z}, {-3.1, 2.55, z}),
                               glow, 0.0, Surface::open});
    Mesh frame;
    for (const double x : {-3.16, -2.43, -1.7})
        frame.append(box({x, 0.69, z - 0.02}, {x + 0.06, 2.61, z + 0.06}));
    for (const double y : {0.63, 1.62, 2.61})
        frame.append(box({-3.2, y, z - 0.03}, {-1.6, y + 0.06, z + 0.07}));
    scene.add("window frame", {frame, stone.wood});
    scene.add("window sill", {box({-3.3, 0.53, z - 0.02}, {-1.5, 0.63, z + 0.2}), stone.trim});
}

void addUpperWall(GlbWriter& scene, const Stone& stone) {
    scene.add("gallery wall", {box({-13.0, 0.0, -11.4}, {6.5, 9.9, -11.0}), stone.plaster});
    scene.add("eaves", {box({-13.1, 9.9, -11.5}, {6.6, 10.05, -10.7}), stone.trim});
    Mesh shutters;
    Mesh sills;
    for (const double sill : {5.3, 7.85})
        for (const double x : {-10.6, -7.4, -4.2, -1.0, 2.2}) {
            sills.append(box({x - 0.7, sill - 0.1, -11.02}, {x + 0.7, sill, -10.84}));
            sills.append(box({x - 0.7, sill + 1.42, -11.02}, {x + 0.7, sill + 1.54, -10.9}));
            for (const double side : {-1.0, 1.0}) {
                const double left = x + 0.28 * side - 0.26;
                for (int slat = 0; slat < 12; ++slat)
                    shutters.append(box({left, sill + 0.02 + 0.115 * slat, -11.0},
                                        {left + 0.52, sill + 0.1 + 0.115 * slat, -10.95}));
            }
        }
    scene.add("string course", {box({-13.0, 7.3, -11.02}, {6.0, 7.42, -10.9}), stone.trim});
    scene.add("shutters", {shutters, stone.wood});
    scene.add("sills", {sills, stone.trim});
}

}  // namespace

void addCloister(GlbWriter& scene) {
    const Stone stone{scene.material({.name = "plaster", .colour = {0.68, 0.53, 0.36}, .roughness = 0.95}),
                      scene.material({.name = "limestone", .colour = {0.66, 0.58, 0.46}, .roughness = 0.8}),
                      scene.material({.name = "roof tile", .colour = {0.56, 0.25, 0.14}, .roughness = 0.85}),
                      scene.material({.name = "old wood", .colour = {0.24, 0.3, 0.28}, .roughness = 0.7})};
    addArcade(scene, stone, {.bays = 5, .bay = 2.1, .spring = 2.05, .top = 3.45}, at({-6.2, 0.0, -8.0}));
    addArcade(scene, stone, {.bays = 5, .bay = 2.1, .spring = 2.05, .top = 3.3},
              turned({-6.2, 0.0, 2.5}, 90.0));
    scene.add("gallery ceiling", {box({-6.4, 3.68, -11.0}, {6.0, 3.78, -7.9}), stone.wood});
    addRoof(scene, stone);
    addWindow(scene, stone);
    addUpperWall(scene, stone);
}

}  // namespace penumbra::assets
