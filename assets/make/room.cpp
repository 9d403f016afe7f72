// A class room with one window: indoors, where ambient occlusion without a limit is black everywhere.
#include "assets/make/random.h"
#include "assets/make/scenes.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {
namespace {

Mesh shell() {
    Mesh mesh = box({-4.2, -0.2, -3.4}, {4.2, -0.005, 3.4});     // floor
    mesh.append(box({-4.21, 3.0, -3.41}, {4.21, 3.2, 3.41}));    // ceiling
    mesh.append(box({-4.22, -0.1, -3.42}, {4.22, 3.1, -3.2}));   // blackboard wall
    mesh.append(box({-4.23, -0.1, 3.2}, {4.23, 3.1, 3.43}));     // wall behind the camera
    mesh.append(box({4.0, -0.11, -3.3}, {4.24, 3.11, 3.3}));     // right wall
    mesh.append(box({-4.24, -0.12, -3.31}, {-4.0, 0.9, 3.31}));  // left wall, around the window
    mesh.append(box({-4.24, 2.5, -3.32}, {-4.0, 3.12, 3.32}));
    mesh.append(box({-4.25, 0.8, -3.33}, {-4.0, 2.6, -1.6}));
    return mesh.append(box({-4.25, 0.8, 1.4}, {-4.0, 2.6, 3.33}));
}

void addLights(GlbWriter& scene, int paint) {
    const int day = scene.material({.name = "daylight", .colour = Vec3(0.0), .radiance = {7.6, 8.6, 10.0}});
    const int lamp = scene.material({.name = "lamp", .colour = Vec3(0.0), .radiance = {13.0, 11.0, 8.0}});
    scene.add("window light",
              {openQuad({-4.2, 0.85, 1.45}, {-4.2, 0.85, -1.65}, {-4.2, 2.55, -1.65}, {-4.2, 2.55, 1.45}),
               day, 0.0, Surface::open});
    scene.add("ceiling light",
              {openQuad({-0.6, 2.549, 0.3}, {-0.6, 2.549, -0.3}, {0.6, 2.549, -0.3}, {0.6, 2.549, 0.3}), lamp,
               0.0, Surface::open});
    Mesh body = box({-0.64, 2.55, -0.34}, {0.64, 2.6, 0.34});
    for (const double x : {-0.5, 0.5}) body.append(bar({x, 2.59, 0.0}, {x, 3.02, 0.0}, 0.006, 6));
    scene.add("lamp body", {body, paint});
}

void addWindowFrame(GlbWriter& scene, int paint) {
    Mesh frame;
    for (const double z : {-1.62, -0.63, 0.37, 1.36})
        frame.append(box({-4.1, 0.88, z}, {-4.04, 2.52, z + 0.06}));
    for (const double y : {0.89, 1.9, 2.45}) frame.append(box({-4.11, y, -1.61}, {-4.03, y + 0.06, 1.41}));
    frame.append(box({-4.06, 0.86, -1.75}, {-3.8, 0.91, 1.55}));
    scene.add("window frame", {frame, paint});
}

Mesh tableLegs() {
    Mesh mesh;
    for (const double x : {-0.55, 0.55})
        for (const double z : {-0.2, 0.2}) mesh.append(bar({x, 0.0, z}, {x, 0.71, z}, 0.018));
    return mesh;
}

Mesh chairWood() {
    Mesh mesh = chamferedBox({-0.2, 0.43, -0.19}, {0.2, 0.45, 0.19}, 0.006);
    return mesh.append(box({-0.2, 0.66, 0.185}, {0.2, 0.84, 0.2}));
}

Mesh chairFrame() {
    Mesh mesh;
    for (const double x : {-0.17, 0.17}) {
        mesh.append(bar({x, 0.0, -0.17}, {x, 0.435, -0.15}, 0.011, 6));
        mesh.append(tube(smoothCurve({{x, 0.0, 0.22}, {x, 0.43, 0.16}, {x, 0.84, 0.205}}, 4), {0.011}, 6));
    }
    return mesh;
}

void addDesks(GlbWriter& scene, int wood, int steel) {
    Random random(5);
    const int table =
        scene.mesh("table", {{chamferedBox({-0.65, 0.705, -0.27}, {0.65, 0.735, 0.27}, 0.006), wood},
                             {tableLegs(), steel, 60.0}});
    const int chair = scene.mesh("chair", {{chairWood(), wood}, {chairFrame(), steel, 60.0}});
    for (const double x : {-2.3, 0.0, 2.3})
        for (const double z : {-0.9, 0.5, 1.9}) {
            const int place = scene.group("desk", turned({x, 0.0, z}, random.uniform(-3.0, 3.0)));
            scene.place("table", table, {}, place);
            for (const double side : {-0.32, 0.32})
                scene.place(
                    "chair", chair,
                    turned({side, 0.0, 0.45 + random.uniform(-0.12, 0.15)}, random.uniform(-22.0, 22.0)),
                    place);
        }
}

void addBoard(GlbWriter& scene, int wood) {
    const int slate = scene.material({.name = "slate", .colour = {0.05, 0.09, 0.075}, .roughness = 0.6});
    const int chalk = scene.material({.name = "chalk", .colour = {0.75, 0.75, 0.72}, .roughness = 1.0});
    scene.add("blackboard", {box({-1.9, 0.95, -3.21}, {1.5, 2.25, -3.17}), slate});
    Mesh frame = box({-1.96, 0.89, -3.21}, {1.56, 0.96, -3.08});
    frame.append(box({-1.96, 2.24, -3.22}, {1.56, 2.3, -3.15}));
    for (const double x : {-1.97, 1.49}) frame.append(box({x, 0.9, -3.23}, {x + 0.07, 2.29, -3.16}));
    scene.add("board frame", {frame, wood});
    Mesh sticks;
    for (const double x : {-1.2, -0.9, 0.7})
        sticks.append(bar({x, 0.966, -3.12}, {x + 0.08, 0.966, -3.11}, 0.006));
    scene.add("chalk", {sticks, chalk, 60.0});
}

void addShelf(GlbWriter& scene, int wood) {
    Mesh shelf = box({3.7, 0.0, -1.9}, {4.01, 2.1, -1.87});
    shelf.append(box({3.7, 0.0, 0.07}, {4.01, 2.1, 0.1}));
    for (int level = 0; level < 6; ++level)
        shelf.append(box({3.705, 0.05 + 0.4 * level, -1.88}, {4.02, 0.075 + 0.4 * level, 0.08}));
    scene.add("bookshelf", {shelf, wood});
    Random random(17);
    const Vec3 cloth[] = {{0.45, 0.13, 0.1}, {0.12, 0.25, 0.36}, {0.5, 0.4, 0.18}, {0.18, 0.28, 0.16}};
    std::vector<Mesh> books(4);
    for (int level = 0; level < 5; ++level)
        for (double z = -1.85; z < -0.05;) {
            const double width = random.uniform(0.02, 0.055), y = 0.075 + 0.4 * level;
            const double front = 3.74 + random.uniform(0.0, 0.05), height = random.uniform(0.2, 0.32);
            if (random.uniform() < 0.93)
                books[std::size_t(random.below(4))].append(box({front, y, z}, {3.99, y + height, z + width}));
            z += width + 0.002;
        }
    for (std::size_t i = 0; i < books.size(); ++i)
        scene.add("books",
                  {books[i], scene.material({.name = "book cloth", .colour = cloth[i], .roughness = 0.8})});
}

void addTeachersDesk(GlbWriter& scene, int wood) {
    const int globe = scene.material({.name = "globe", .colour = {0.16, 0.36, 0.5}, .roughness = 0.35});
    const int place = scene.group("teacher's desk", turned({2.4, 0.0, -2.35}, -14.0));
    Mesh desk = chamferedBox({-0.8, 0.73, -0.38}, {0.8, 0.77, 0.38}, 0.008);
    desk.append(box({-0.76, 0.0, -0.35}, {-0.3, 0.735, 0.34}))
        .append(box({0.3, 0.0, -0.35}, {0.76, 0.735, 0.34}));
    scene.add("desk", {desk, wood}, {}, place);
    scene.add("globe", {sphere(0.16, 3), globe, 60.0}, at({0.45, 1.0, 0.0}), place);
    scene.add("globe stand",
              {lathe({{0.0, 0.77}, {0.12, 0.77}, {0.12, 0.785}, {0.02, 0.8}, {0.015, 0.86}, {0.0, 0.86}}, 20),
               wood, 40.0},
              at({0.45, 0.0, 0.0}), place);
    Mesh pile = box({-0.5, 0.77, -0.1}, {-0.25, 0.8, 0.08});
    scene.add("books", {pile.append(box({-0.48, 0.8, -0.12}, {-0.24, 0.83, 0.06})), wood}, {}, place);
}

}  // namespace

GlbWriter makeRoom() {
    GlbWriter scene("room");
    scene.camera("camera", looking({3.3, 1.75, 3.05}, {-0.7, 0.85, -1.4}), 58.0, 0.1, 30.0);
    const int wall = scene.material({.name = "wall paint", .colour = {0.72, 0.69, 0.6}, .roughness = 0.95});
    const int planks = scene.material({.name = "floor", .colour = {0.46, 0.32, 0.2}, .roughness = 0.5});
    const int wood = scene.material({.name = "beech", .colour = {0.6, 0.42, 0.24}, .roughness = 0.5});
    const int paint = scene.material({.name = "white paint", .colour = {0.7, 0.7, 0.68}, .roughness = 0.6});
    const int steel = scene.material({.name = "steel", .colour = {0.3, 0.32, 0.34}, .roughness = 0.3});
    addLights(scene, paint);
    scene.add("walls", {shell(), wall});
    Mesh boards;
    for (int i = 0; i < 32; ++i)
        boards.append(box({-4.0 + 0.25 * i + 0.002, -0.02, -3.2}, {-3.75 + 0.25 * i, 0.0, 3.2}));
    scene.add("floor boards", {boards, planks});
    addWindowFrame(scene, paint);
    addDesks(scene, wood, steel);
    addBoard(scene, wood);
    addShelf(scene, wood);
    addTeachersDesk(scene, wood);
    return scene;
}

}  // namespace penumbra::assets
