// Triangles as a Scene, rounded to float: what rays, hierarchies and bakes are given.
#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "common/truth/cone_subtraction.h"

namespace penumbra::stress {

/// One part, no vertex shared; the normals are those of the triangles, and up where a triangle has none.
Scene sceneOf(const std::vector<Triangle>& triangles);
/// What the floats of the scene are.
std::vector<Triangle> trianglesIn(const Scene& scene);

}  // namespace penumbra::stress
