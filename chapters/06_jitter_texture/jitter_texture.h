// The tile of patterns as a 3D texture: s and t from gl_FragCoord, depth the sample.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "chapters/06_jitter_texture/jitter_pattern.h"
#include "common/gl/gl_object.h"

namespace penumbra {

/// What one texel holds. A look-up costs about the same whatever it brings, so the more the better.
enum class JitterLayout {
    packed8,   ///< RGBA32UI: eight points, a signed byte for each coordinate (1/127 of the radius)
    packed16,  ///< RGBA32UI: four points, 16 bits for each coordinate
    snorm8,    ///< RGBA8_SNORM: two points, as in the lecture
    lecture    ///< the same, filtered look-ups as the lecture writes them, and bilinear comparisons
};

/// "packed8", "packed16", "snorm8", "lecture": in the order of the constants.
const std::vector<std::string>& jitterLayoutNames();

/// A coordinate in [-1,1] in `bits` bits, two's complement: to the nearest, so that nothing is drawn towards
/// the centre. 0 stays 0.
int quantized(float coordinate, int bits);

/// The bytes of the texture, slice by slice: for tests, and for the upload.
std::vector<std::uint32_t> packedWords(const JitterTile& tile, JitterLayout layout);

class JitterTexture {
 public:
    JitterTexture(const JitterTile& tile, JitterLayout layout);
    GLuint id() const { return texture_.id(); }

 private:
    GlTexture texture_;
};

}  // namespace penumbra
