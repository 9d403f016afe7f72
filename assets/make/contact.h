// The things of scene `contact`, for scenes that light them in another way.
#pragma once

#include "assets/make/glb_writer.h"

namespace penumbra::assets {

void addContactCamera(GlbWriter& scene);
/// Floor, wall, box, plank and post, and the note about them.
void addContactThings(GlbWriter& scene);

}  // namespace penumbra::assets
