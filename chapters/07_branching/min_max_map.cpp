#include "chapters/07_branching/min_max_map.h"

#include <cmath>

#include "common/app/pass_timer.h"

namespace penumbra {

MinMaxMap::MinMaxMap(bool gather)
    : gather_(gather),
      blocks_("common/fullscreen.vert", "07_branching/min_max_blocks.frag"),
      dilate_("common/fullscreen.vert", "07_branching/min_max_dilate.frag") {}

void MinMaxMap::Target::provide(const glm::ivec2& wanted) {
    if (size == wanted) return;
    size = wanted;
    glBindTexture(GL_TEXTURE_2D, texture.id());
    // Integers: OpenGL ES 3.0 need not render to floats.
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32I, size.x, size.y, 0, GL_RGBA_INTEGER, GL_INT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    requireCompleteFramebuffer("minimum-maximum map");
}

void MinMaxMap::Target::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glViewport(0, 0, size.x, size.y);
}

// [begin:build]
void MinMaxMap::build(const ShadowMap& map, DepthRange range, const std::array<glm::vec2, 3>& slopes,
                      float reach, const Frame& frame) {
    const Key wanted{map.revision(), slopes, reach};
    if (frame.skips(keptMinMax) && held_ == wanted) return;
    const PassScope scope(frame.passTimer, "min-max");

    // A kernel that begins anywhere in a block and is 2 reach long ends in one of this many blocks.
    window_ = int(std::ceil(1.0f + 2.0f * reach / block));
    before_ = int(std::ceil(reach / block));
    const int count = (map.size() + block - 1) / block;
    texelFromSt_ =
        glm::vec2(float(map.size()), float(block * before_) - reach) / float(block * (count + before_));
    blockwise_.provide({count, count});
    along_.provide({count + before_, count});
    dilated_.provide({count + before_, count + before_});

    GLint viewport[4];
    glGetIntegerv(GL_VIEWPORT, viewport);
    glDisable(GL_DEPTH_TEST);
    held_ = wanted;
    reduceToBlocks(map, range);
    dilate(blockwise_, along_, false, map.size());
    dilate(along_, dilated_, true, map.size());
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
    frame.work["min_max_maps_built"] += 1;
}
// [end:build]

void MinMaxMap::reduceToBlocks(const ShadowMap& map, DepthRange range) {
    std::vector<std::string> defines;
    if (gather_) defines.push_back("USE_GATHER");
    if (range == DepthRange::reversed) defines.push_back("REVERSED");
    Program& program = blocks_.with(defines);
    program.setTexture("uShadowMap", GL_TEXTURE_2D, map.texture());
    setSlopes(program);
    program.prepareToDraw();
    blockwise_.bind();
    triangle_.draw();
}

void MinMaxMap::dilate(const Target& from, const Target& to, bool alongT, int mapSize) {
    std::vector<std::string> defines{"COUNT " + std::to_string(window_)};
    if (alongT) defines.push_back("ALONG_T");
    Program& program = dilate_.with(defines);
    program.setTexture("uBlocks", GL_TEXTURE_2D, from.texture.id());
    program.set("uBefore", before_);
    program.set("uMapSize", mapSize);
    setSlopes(program);
    program.prepareToDraw();
    to.bind();
    triangle_.draw();
}

void MinMaxMap::setSlopes(Program& program) const {
    program.set("uSlope0", held_->slopes[0]);
    program.set("uSlope1", held_->slopes[1]);
    program.set("uSlope2", held_->slopes[2]);
}

std::vector<Program*> MinMaxMap::programs() {
    std::vector<Program*> all = blocks_.compiled(), dilations = dilate_.compiled();
    all.insert(all.end(), dilations.begin(), dilations.end());
    return all;
}

void MinMaxMap::set(Program& program) const {
    program.setTexture("uMinMax", GL_TEXTURE_2D, texture());
    program.set("uReach", held_->reach);
    program.set("uWindow", texelFromSt_);
}

}  // namespace penumbra
