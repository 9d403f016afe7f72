#include "assets/make/courtyard.h"
#include "assets/make/figure.h"
#include "assets/make/masonry.h"

namespace penumbra::assets {

void addFountain(GlbWriter& scene) {
    const int stone =
        scene.material({.name = "fountain stone", .colour = {0.62, 0.57, 0.49}, .roughness = 0.7});
    const int marble = scene.material({.name = "marble", .colour = {0.74, 0.7, 0.63}, .roughness = 0.4});
    const int water = scene.material({.name = "water", .colour = {0.08, 0.2, 0.21}, .roughness = 0.12});
    const int place = scene.group("fountain", turned({0.1, 0.0, -3.4}, 22.5));
    scene.add("basin", {basin(8, 1.35, 0.58, 0.2), stone}, {}, place);
    scene.add("water", {lathe({{0.0, 0.3}, {1.18, 0.3}, {1.18, 0.44}, {0.0, 0.44}}, 8), water}, {}, place);
    const Mesh pedestal = lathe({{0.0, 0.1},
                                 {0.46, 0.1},
                                 {0.46, 0.5},
                                 {0.42, 0.54},
                                 {0.36, 0.58},
                                 {0.32, 0.66},
                                 {0.31, 0.92},
                                 {0.34, 0.98},
                                 {0.42, 1.02},
                                 {0.42, 1.1},
                                 {0.38, 1.12},
                                 {0.0, 1.12}},
                                24);
    scene.add("pedestal", {pedestal, stone, 35.0}, {}, place);
    scene.add("water carrier", {waterCarrier(), marble, 80.0},
              turned({0.0, 1.12, 0.0}, -40.0, {0, 1, 0}, 1.06), place);
}

}  // namespace penumbra::assets
