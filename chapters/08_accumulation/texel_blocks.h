// A receiver's texels in blocks, each with the triangles that reach between it and the light.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "chapters/08_accumulation/receiver.h"
#include "common/truth/cone_subtraction.h"

namespace penumbra {

/// The corners of a block of texels: of the parallelogram of their centres, and `margin` texels around it.
std::array<glm::dvec3, 4> texelCorners(const Receiver& receiver, const glm::ivec2& first,
                                       const glm::ivec2& size, double margin);

struct TexelBlock {
    glm::ivec2 first{0}, size{0};         ///< texels
    std::span<const Triangle> occluders;  ///< in the order given; valid during the visit only
};

struct BlockRequest {
    int blockTexels = 8;  ///< edge of the smallest block, aligned to multiples of itself
    int firstRow = 0;     ///< a multiple of blockTexels
    int rows = 0;         ///< 0: all
};

/// Covers the rows asked for once with blocks: what something reaches is halved down to the smallest blocks,
/// what nothing reaches is one large block. One after the other, on the calling thread.
void visitBlocks(const Receiver& receiver, const Light& light, std::span<const Triangle> occluders,
                 const BlockRequest& request, const std::function<void(const TexelBlock&)>& visit);

}  // namespace penumbra
