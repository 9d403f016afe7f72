// The things of `contact` under a square panel in place of its lamps: shadows that are hard where things
// touch and soft away from there, with an exact answer.
#include "assets/make/contact.h"
#include "assets/make/scenes.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {

GlbWriter makeContactPanel() {
    GlbWriter scene("contact_panel");
    addContactCamera(scene);
    addContactThings(scene);
    // Where the lamp behind the wall is in `contact`, facing the same way, 0.8 m wide.
    const Vec3 centre(-3.2, 3.4, -4.2), forward = glm::normalize(Vec3(0.2, 0.2, 0.0) - centre);
    const Vec3 a = 0.4 * glm::normalize(glm::cross(forward, Vec3(0.0, 1.0, 0.0)));
    const Vec3 b = 0.4 * glm::normalize(glm::cross(a, forward));
    const int glow =
        scene.material({.name = "panel", .colour = Vec3(0.0), .radiance = {172.0, 153.0, 125.0}});
    scene.add("panel", {openQuad(centre - a - b, centre - a + b, centre + a + b, centre + a - b), glow, 0.0,
                        Surface::open});
    return scene;
}

}  // namespace penumbra::assets
