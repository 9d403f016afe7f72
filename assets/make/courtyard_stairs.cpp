#include "assets/make/courtyard.h"
#include "assets/make/ironwork.h"
#include "assets/make/masonry.h"

namespace penumbra::assets {
namespace {

constexpr int steps = 14;
constexpr double rise = 0.17, run = 0.3, stairWidth = 1.6, landing = 3.4;
constexpr double left = 4.3, foot = -0.4;  // x of the open side, z of the first riser
constexpr double top = steps * rise, turn = foot - steps * run;

void addDoor(GlbWriter& scene, int wood, int trim) {
    Mesh planks;
    for (int i = 0; i < 6; ++i)
        planks.append(box({5.84, top, turn - 2.0 + 0.18 * i}, {5.91, top + 2.0, turn - 1.835 + 0.18 * i}));
    scene.add("door", {planks, wood});
    Mesh frame = box({5.8, top, turn - 2.14}, {5.95, top + 2.1, turn - 2.02});
    frame.append(box({5.8, top, turn - 0.9}, {5.95, top + 2.1, turn - 0.78}));
    frame.append(box({5.79, top + 2.1, turn - 2.2}, {5.96, top + 2.24, turn - 0.72}));
    scene.add("door frame", {frame, trim});
}

}  // namespace

void addStairWing(GlbWriter& scene) {
    const int plaster =
        scene.material({.name = "ochre plaster", .colour = {0.7, 0.47, 0.26}, .roughness = 0.95});
    const int stone = scene.material({.name = "step stone", .colour = {0.58, 0.52, 0.43}, .roughness = 0.75});
    const int iron = scene.material({.name = "iron", .colour = {0.1, 0.11, 0.12}, .roughness = 0.35});
    const int wood = scene.material({.name = "door wood", .colour = {0.3, 0.16, 0.08}, .roughness = 0.6});

    scene.add("stair wall", {box({5.9, 0.0, -11.2}, {6.4, 9.9, 4.5}), plaster});
    Mesh coping = box({5.72, 9.9, -11.2}, {6.5, 10.05, 4.6});
    scene.add("coping", {coping.append(box({5.86, 0.0, -0.4}, {5.93, 0.5, 4.5})), stone});
    scene.add("stairs", {stairs(steps, rise, run, stairWidth, landing), stone}, at({left, 0.0, foot}));
    scene.add("string course", {box({5.82, 6.1, -11.0}, {6.0, 6.24, 4.5}), stone});
    Mesh nosings;
    for (int i = 0; i < steps; ++i)
        nosings.append(box({left - 0.03, (i + 1) * rise - 0.035, foot - i * run - 0.2},
                           {left + stairWidth, (i + 1) * rise + 0.012, foot - i * run + 0.025}));
    scene.add("treads", {nosings, stone});

    scene.add("stair railing", {railing(steps * run, 0.95, 0.15, 0.009, top), iron, 60.0},
              turned({left + 0.06, 0.15, foot - 0.1}, 90.0));
    scene.add("landing railing", {railing(landing, 0.95, 0.13, 0.009), iron, 60.0},
              turned({left + 0.06, top, turn}, 90.0));
    addDoor(scene, wood, stone);
}

}  // namespace penumbra::assets
