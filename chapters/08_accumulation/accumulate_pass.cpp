#include "chapters/08_accumulation/accumulate_pass.h"

namespace penumbra {

void setPlane(Program& program, const Receiver& receiver) {
    const PlaneEdges edges = planeEdges(receiver);
    program.set("uUEdge", edges.u);
    program.set("uVEdge", edges.v);
    program.set("uTexels", glm::vec2(receiver.texels));
}

std::vector<std::string> weightDefines(const std::string& weights) {
    if (weights == "equal") return {"EQUAL_WEIGHTS"};
    return {};
}

AccumulatePass::AccumulatePass()
    : occluder_("08_accumulation/project.vert", "08_accumulation/occluder.frag"),
      add_("common/fullscreen.vert", "08_accumulation/add_sample.frag") {
    occluder_.set("uCovered", glm::vec4(1.0f));
}

void AccumulatePass::run(const Frame& frame, const Receiver& receiver, const ShadowPlan& plan, int lightPart,
                         const std::vector<glm::vec4>& weights, const std::string& weighting,
                         const TexelTarget& sums) {
    if (!covered_ || covered_->size() != sums.size()) covered_.emplace(sums.size(), GL_R8);
    Program& add = add_.with(weightDefines(weighting));
    setPlane(add, receiver);
    add.setTexture("uCovered", GL_TEXTURE_2D, covered_->texture());
    occluders_.begin(frame, plan, lightPart);
    sums.clear(glm::vec4(0.0f));
    glBlendFunc(GL_ONE, GL_ONE);
    // [begin:accumulate]
    for (int point = 0; point < int(plan.points.size()); ++point) {
        covered_->clear(glm::vec4(0.0f));
        occluders_.draw(occluder_, point, 1);

        sums.bind();
        add.set("uLightPoint", weights[std::size_t(point)]);
        add.prepareToDraw();
        glEnable(GL_BLEND);
        triangle_.draw();
        glDisable(GL_BLEND);
    }
    // [end:accumulate]
    glBlendFunc(GL_ONE, GL_ZERO);
}

std::vector<Program*> AccumulatePass::programs() {
    std::vector<Program*> all = add_.compiled();
    all.push_back(&occluder_);
    return all;
}

}  // namespace penumbra
