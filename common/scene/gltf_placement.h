// Where the origin of a scene lies, and a mesh carried there. Internal to the loader.
#pragma once

#include <glm/glm.hpp>

#include "common/scene/gltf_flatten.h"
#include "common/scene/gltf_mesh.h"

namespace penumbra::gltf {

/// A point near `view`, on a grid of a power of two metres, about four times the radius of the scene and at
/// most 64.
///
/// Why a grid: if the scene moves by a multiple of the grid step, the origin moves by exactly as much, every
/// difference to it is the same, and so is every float. 1e6 = 2^6 * 15625 is a multiple of every step up
/// to 64. With the view itself as origin, the rounding of its coordinate out there (6e-11 m at 1e6) would
/// shift everything, and one float in some hundred would come out another one. Why four times: an ordinary
/// scene around its file's origin then keeps the file's own numbers. What the grid costs is a few bits of
/// float precision at most, since |p| stays below about three radii.
glm::dvec3 chooseOrigin(const glm::dvec3& view, double radius);

glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p);

/// The mesh in scene space: positions rounded to float once, after the whole transform; normals by the
/// cofactor matrix; triangles turned round where the transform mirrors, so that counter-clockwise stays the
/// front; KHR_texture_transform applied.
PartMesh placeMesh(LocalMesh&& local, const glm::dmat4& sceneFromMesh, const glm::dmat3& uvFromFile);

}  // namespace penumbra::gltf
