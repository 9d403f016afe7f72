#include "chapters/08_accumulation/mask_pass.h"

#include <fmt/format.h>

#include <algorithm>

#include "chapters/08_accumulation/accumulate_pass.h"
#include "common/app/pass_timer.h"

namespace penumbra {

namespace {

constexpr int pointsInLayer = MaskLayers::pointsInLayer;
/// Of the resolve pass: 192 light points, since OpenGL ES promises 224 vectors to a fragment shader.
constexpr int layersInPass = 6;

std::vector<std::string> maskDefines(const MaskLayers& masks) {
    if (masks.setting() == BitSetting::stencil) return {"BYTES"};
    return {};
}

}  // namespace

MaskPass::MaskPass()
    : bits_("08_accumulation/project.vert", "08_accumulation/mask_bit.frag"),
      byteBits_("08_accumulation/project.vert", "08_accumulation/occluder.frag"),
      classify_("08_accumulation/texels.vert", "08_accumulation/classify.frag"),
      resolve_("08_accumulation/texels.vert", "08_accumulation/resolve.frag") {
    glBindVertexArray(texelArray_.id());
    glBindBuffer(GL_ARRAY_BUFFER, texels_.id());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    glBindVertexArray(0);
}

void MaskPass::draw(const Frame& frame, const ShadowPlan& plan, int lightPart, const MaskLayers& masks) {
    const PassScope scope(frame.passTimer, "occluders");
    occluders_.begin(frame, plan, lightPart);
    if (masks.setting() == BitSetting::logicOp)
        drawByLogicOp(plan, masks);
    else
        drawByStencil(plan, masks);
}

// [begin:logic-op]
void MaskPass::drawByLogicOp(const ShadowPlan& plan, const MaskLayers& masks) {
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_OR);
    const int points = int(plan.points.size());
    for (int first = 0; first < points; first += pointsInLayer) {
        masks.bindCleared(first / pointsInLayer);
        occluders_.draw(bits_, first, std::min(pointsInLayer, points - first));
    }
    glDisable(GL_COLOR_LOGIC_OP);
}
// [end:logic-op]

// [begin:stencil]
/// 2^b added once to a byte sets its bit b. The stencil remembers the last point that hid a texel, and lets
/// the second of two overlapping triangles add nothing.
void MaskPass::drawByStencil(const ShadowPlan& plan, const MaskLayers& masks) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    for (int point = 0; point < int(plan.points.size()); ++point) {
        const int bit = point % pointsInLayer;
        if (bit == 0) masks.bindCleared(point / pointsInLayer);
        glm::vec4 covered(0.0f);
        covered[bit / 8] = float(1 << (bit % 8)) / 255.0f;
        glStencilFunc(GL_NOTEQUAL, bit + 1, 0xff);
        byteBits_.set("uCovered", covered);
        occluders_.draw(byteBits_, point, 1);
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);
}
// [end:stencil]

void MaskPass::drawTexels(Program& program, const PackedSums& sums) {
    program.set("uFragments", glm::vec2(sums.fragments()));
    program.prepareToDraw();
    glBindVertexArray(texelArray_.id());
    glDrawArrays(GL_TRIANGLES, 0, texelCount_);
}

void MaskPass::resolve(const Receiver& receiver, const ShadowPlan& plan,
                       const std::vector<glm::vec4>& weights, const std::string& weighting, bool everywhere,
                       const MaskLayers& masks, const PackedSums& sums) {
    const std::vector<glm::vec2> texels = everywhere ? wholeTexture(receiver.texels) : plan.texels;
    glBindBuffer(GL_ARRAY_BUFFER, texels_.id());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(texels.size() * sizeof(glm::vec2)), texels.data(),
                 GL_STREAM_DRAW);
    texelCount_ = GLsizei(texels.size());
    std::vector<std::string> defines = maskDefines(masks);
    glEnable(GL_DEPTH_TEST);
    // [begin:resolve]
    // What no shadow reaches is lit, and its depth 0 keeps it out of the passes below.
    sums.clear(everywhere ? 0.0f : 1.0f, everywhere ? 1.0f : 0.0f);
    if (!everywhere) {
        Program& classify = classify_.with(defines);
        classify.setTexture("uMasks", GL_TEXTURE_2D_ARRAY, masks.texture());
        classify.set("uPoints", int(plan.points.size()));
        glDepthFunc(GL_ALWAYS);
        drawTexels(classify, sums);
    }
    // Mixed texels only: the others fail the depth test before they are shaded.
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    const std::vector<std::string> more = weightDefines(weighting);
    defines.insert(defines.end(), more.begin(), more.end());
    defines.push_back(fmt::format("LAYERS {}", layersInPass));
    Program& resolve = resolve_.with(defines);
    resolve.setTexture("uMasks", GL_TEXTURE_2D_ARRAY, masks.texture());
    setPlane(resolve, receiver);
    for (int layer = 0; layer < masks.layers(); layer += layersInPass) {
        const std::size_t first = std::size_t(pointsInLayer) * std::size_t(layer);
        std::vector<glm::vec4> points(pointsInLayer * layersInPass, glm::vec4(0, 0, 1, 0));
        std::copy_n(weights.begin() + long(first), std::min(weights.size() - first, points.size()),
                    points.begin());
        resolve.set("uFirstLayer", layer);
        resolve.set("uLayers", std::min(layersInPass, masks.layers() - layer));
        resolve.set("uLightPoints", points);
        drawTexels(resolve, sums);
    }
    // [end:resolve]
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

std::vector<Program*> MaskPass::programs() {
    std::vector<Program*> all = classify_.compiled(), resolving = resolve_.compiled();
    all.insert(all.end(), resolving.begin(), resolving.end());
    all.insert(all.end(), {&bits_, &byteBits_});
    return all;
}

}  // namespace penumbra
