#include "chapters/06_jitter_texture/jitter_texture.h"

#include <cmath>

namespace penumbra {

namespace {

/// Points in a word: two coordinates of 8 bits each make two, of 16 bits one.
int pointsInWord(JitterLayout layout) {
    return layout == JitterLayout::packed16 ? 1 : 2;
}

std::uint32_t word(std::span<const glm::vec2> column, int index, JitterLayout layout) {
    if (layout == JitterLayout::packed16) {
        const glm::vec2 p = column[std::size_t(index)];
        return (std::uint32_t(quantized(p.x, 16)) & 0xffffu) | std::uint32_t(quantized(p.y, 16)) << 16;
    }
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) {
        const float coordinate = column[2 * index + i / 2][i % 2];
        bits |= (std::uint32_t(quantized(coordinate, 8)) & 0xffu) << (8 * i);
    }
    return bits;
}

}  // namespace

const std::vector<std::string>& jitterLayoutNames() {
    static const std::vector<std::string> names{"packed8", "packed16", "snorm8", "lecture"};
    return names;
}

int quantized(float coordinate, int bits) {
    return int(std::lround(coordinate * float((1 << (bits - 1)) - 1)));
}

// [begin:pack]
std::vector<std::uint32_t> packedWords(const JitterTile& tile, JitterLayout layout) {
    const bool snorm = layout == JitterLayout::snorm8 || layout == JitterLayout::lecture;
    const int wordsInTexel = snorm ? 1 : 4;
    const int pointsInTexel = wordsInTexel * pointsInWord(layout);
    std::vector<std::uint32_t> words;
    for (int slice = 0; slice < tile.samples() / pointsInTexel; ++slice)
        for (int y = 0; y < tile.size(); ++y)
            for (int x = 0; x < tile.size(); ++x)
                for (int i = 0; i < wordsInTexel; ++i)
                    words.push_back(word(tile.column(x, y), slice * wordsInTexel + i, layout));
    return words;
}
// [end:pack]

JitterTexture::JitterTexture(const JitterTile& tile, JitterLayout layout) {
    const std::vector<std::uint32_t> words = packedWords(tile, layout);
    const bool snorm = layout == JitterLayout::snorm8 || layout == JitterLayout::lecture;
    const GLsizei size = tile.size();
    const GLsizei slices = GLsizei(words.size()) / (size * size * (snorm ? 1 : 4));
    glBindTexture(GL_TEXTURE_3D, texture_.id());
    if (snorm)
        glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8_SNORM, size, size, slices, 0, GL_RGBA, GL_BYTE, words.data());
    else
        glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA32UI, size, size, slices, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                     words.data());
    // A blend of two patterns is not stratified, and blue noise blended is grey: no filter.
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(GL_TEXTURE_3D, wrap, GL_REPEAT);
}

}  // namespace penumbra
