// Planar emissive parts as area lights.
#pragma once

#include "common/scene/scene.h"

namespace penumbra {

/// Adds a light of type area for every part whose material emits and whose triangles lie in one plane and
/// face one way. Its polygons are the triangles, merged where that leaves a convex polygon of at most
/// `maxLightCorners` corners. A part that emits and is not planar keeps its emissive colour, gives no light,
/// and is mentioned in Scene::notes.
void addAreaLights(Scene& scene);

/// Exact visibility clips light polygons in arrays of fixed size: a disk of 64 sides becomes a few polygons.
constexpr std::size_t maxLightCorners = 8;

}  // namespace penumbra
