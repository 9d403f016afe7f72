// Is a mesh the boundary of a solid, seen from outside?
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace penumbra {

/// True if, with vertices of equal position taken as one, every edge is shared by exactly two triangles that
/// run through it in opposite directions, and every connected shell has a positive volume (its front faces
/// look outwards). So a room modelled from inside, or a ball with flipped faces, is not closed in this sense.
/// A mesh without triangles is not.
///
/// What it can't see: a shell that passes through itself. Where one encloses space the wrong way round (the
/// inner lobe of a figure eight), its nearest surface is a back face, and culling would open a hole.
bool isClosed(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace penumbra
