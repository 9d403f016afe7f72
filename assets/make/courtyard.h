// The parts of the courtyard scene. Each adds its own nodes.
#pragma once

#include "assets/make/glb_writer.h"

namespace penumbra::assets {

void addGround(GlbWriter& scene);
void addCloister(GlbWriter& scene);   ///< the arcades on the left and at the back, roof, window
void addStairWing(GlbWriter& scene);  ///< wall, stairs, railings on the right
void addFountain(GlbWriter& scene);
void addGarden(GlbWriter& scene);     ///< tree, pots, ivy
void addFurniture(GlbWriter& scene);  ///< bench, lamp post, jars

/// Where the light in the lantern is.
constexpr Vec3 lanternLight{2.95, 2.34, -0.5};

}  // namespace penumbra::assets
