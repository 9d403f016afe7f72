// What a scene gets when its file has no camera, or no light.
#pragma once

#include "common/scene/scene.h"

namespace penumbra {

/// If there is no camera: one that sees all of `bounds` from the front, the right and above.
void addFittedCamera(Scene& scene);

/// If there is no light: a sun from the upper left, pi W/m^2 on a plane that faces it (a white surface then
/// has radiance 1).
void addSun(Scene& scene);

}  // namespace penumbra
