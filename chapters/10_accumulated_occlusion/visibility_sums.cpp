#include "chapters/10_accumulated_occlusion/visibility_sums.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "chapters/10_accumulated_occlusion/direction_batches.h"

namespace penumbra {

TexturePair::TexturePair(const glm::ivec2& size) : first_(size, GL_RGBA32F), second_(size, GL_RGBA32F) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, first_.id(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, second_.id(), 0);
    const GLenum targets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, targets);
    requireCompleteFramebuffer("float sums of visibility (RGBA32F cannot be drawn into)");
}

void TexturePair::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, size().x, size().y);
}

void TexturePair::clear() const {
    bind();
    const float zero[4] = {};
    glClearBufferfv(GL_COLOR, 0, zero);
    glClearBufferfv(GL_COLOR, 1, zero);
}

std::vector<glm::vec4> TexturePair::readFirst() const {
    bind();
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    return readTexels(size());
}

namespace {

void setMaps(Program& program, const SkyMaps& maps, const SkyBatch& batch) {
    std::vector<glm::vec4> right, up, radiance;
    for (std::size_t i = 0; i < batch.frusta.size(); ++i) {
        const glm::dmat4 axes =
            glm::transpose(batch.frusta[i].lightViewFromWorld);  // of the view, in the world
        right.emplace_back(axes[0]);
        up.emplace_back(axes[1]);
        radiance.emplace_back(glm::vec3(batch.radiances[i]), 0.0f);
    }
    const LightFrustum& any = batch.frusta.front();  // all are around the same sphere
    program.set("uCentre", glm::vec3(any.eye));
    program.set("uPerRadius", float(1.0 / any.far));
    program.set("uRight", right);
    program.set("uUp", up);
    program.set("uRadiance", radiance);
    program.set("uCount", int(batch.frusta.size()));
    program.setTexture("uMaps", GL_TEXTURE_2D_ARRAY, maps.texture());
}

void setCones(Program& program, const SkyBatch& batch) {
    std::vector<glm::vec4> cones;
    for (std::size_t first = 0; first < batch.directions.size(); first += VisibilitySums::leaf) {
        const std::size_t count = std::min(VisibilitySums::leaf, batch.directions.size() - first);
        const DirectionCone cone =
            batch.skip ? coneAround(batch.directions.subspan(first, count)) : DirectionCone{};
        cones.emplace_back(glm::vec3(cone.axis), float(cone.below));
    }
    program.set("uCones", cones);
}

void setBias(Program& program, const SkyMaps& maps, const SkyBatch& batch) {
    program.set("uMapSize", float(maps.mapSize()));
    program.set("uBiasPerSlope", batch.bias * batch.bound.perSlope);
    program.set("uBias", batch.bias * batch.bound.constant);
    if (batch.cellTangent <= 0.0) return;
    // A circle halves a disk at 1 / sqrt(2) of its radius.
    program.set("uCell", float(maps.mapSize() * batch.cellTangent * std::numbers::sqrt2 / 2.0));
}

}  // namespace

VisibilitySums::VisibilitySums()
    : add_("common/fullscreen.vert", "10_accumulated_occlusion/accumulate.frag"),
      resolve_("common/fullscreen.vert", "10_accumulated_occlusion/resolve.frag") {}

void VisibilitySums::clear(const glm::ivec2& size) {
    if (!sums_[0] || sums_[0]->size() != size)
        for (std::optional<TexturePair>& pair : sums_) pair.emplace(size);
    sums_[0]->clear();
}

void VisibilitySums::add(const Receivers& receivers, const SkyMaps& maps, const SkyBatch& added) {
    std::vector<std::string> defines;
    defines.reserve(4);
    defines.emplace_back("BATCH " + std::to_string(batch));
    defines.emplace_back("LEAF " + std::to_string(leaf));
    if (added.countWork) defines.emplace_back("COUNT_WORK");
    if (added.cellTangent > 0.0) defines.emplace_back("SOFT_EDGES");
    Program& program = add_.with(defines);
    setMaps(program, maps, added);
    setBias(program, maps, added);
    setCones(program, added);
    program.setTexture("uPositions", GL_TEXTURE_2D, receivers.positions());
    program.setTexture("uNormals", GL_TEXTURE_2D, receivers.normals());
    program.setTexture("uFacets", GL_TEXTURE_2D, receivers.facets());
    program.setTexture("uSeen", GL_TEXTURE_2D, sums_[0]->first());
    program.setTexture("uReceived", GL_TEXTURE_2D, sums_[0]->second());
    program.prepareToDraw();
    // [begin:ping-pong]
    // The new sums go into the other pair of textures: no blending of floats is needed, which not every
    // OpenGL ES can do, and the sums are those of one long loop, to the bit, however the maps are cut into
    // batches.
    sums_[1]->bind();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
    std::swap(sums_[0], sums_[1]);
    // [end:ping-pong]
}

const TexturePair& VisibilitySums::resolve(int directions) {
    resolve_.setTexture("uSeen", GL_TEXTURE_2D, sums_[0]->first());
    resolve_.setTexture("uReceived", GL_TEXTURE_2D, sums_[0]->second());
    resolve_.set("uPerDirection", 1.0f / float(directions));
    resolve_.prepareToDraw();
    sums_[1]->bind();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
    return *sums_[1];
}

std::vector<Program*> VisibilitySums::programs() {
    std::vector<Program*> all = add_.compiled();
    all.push_back(&resolve_);
    return all;
}

}  // namespace penumbra
