// Chapter 03: bias against acne, leaks against bias.
//
// The map's depth was taken at the centre of a texel, the point is somewhere in it: on a slope the two
// differ, and the surface shadows itself. A bias hides the difference, and too much of it lets light leak
// under walls. How much is needed can be derived from the slope, the format and the arithmetic; `--method`
// compares that bound with the remedies in use.
#include "chapters/02_shadow_test/shadow_test.h"
#include "chapters/03_polygon_offset/depth_bias.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

#include <map>

using namespace penumbra;

namespace {

class PolygonOffset : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        pass_.options.declare(parameters);
        declareOutside(parameters, outside_);
        parameters.add("method", method_, biasMethodNames(), "remedy for acne; slope is the derived bound");
        parameters.add("bias", bias_, 0.0f, 32.0f, "",
                       "multiple of what the method asks for; 0: stripes of acne, 8: shadows detach");
    }

    void load(const Scene&, const Context*) override {
        pass_.load();
        peel_.emplace("01_depth_from_light/depth.vert", "03_polygon_offset/peel.frag");
        biased_.clear();
        secondLayer_.reset();
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01), drawn as the method wants it.
        const BiasMethod method = biasMethod(method_);
        const LightSight sight = pass_.fit(frame);
        const DepthErrors errors = bothPassesErrors(sight.map, sight.frustum, frame.scene.bounds);
        const CasterDraw draw = casterDraw(method, sight.frustum, errors, bias_);
        pass_.draw(frame, sight, draw);

        // Pass 1b, midpoint only: what lies behind the nearest surface.
        const ShadowMap& second =
            method == BiasMethod::midpoint ? peel(frame, sight, errors, draw) : sight.map;

        // Pass 2: the picture, compared with a bias.
        const PassScope scope(frame.passTimer, "shading");
        if (frame.view == "depth") return pass_.show(frame, sight);
        clearPicture(frame, pass_.options);
        glEnable(GL_DEPTH_TEST);
        Program& biased = program(method);
        setPicture(biased, frame, pass_.options, sight, outside_);
        setBias(biased, errors, second, sight.frustum);
        biased.set("uView", viewNumber(frame.view));
        drawPicture(biased, frame);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        requireVisibility(request, "03");
        return visibilityTruth(request.scene, request.tracer, request.camera,
                               pass_.options.chosenLight(request.scene), request.size, true,
                               request.progress);
    }

    std::vector<Program*> programs() override {
        std::vector<Program*> all{&*peel_};
        for (auto& [method, program] : biased_) all.push_back(&program);
        return pass_.programs(std::move(all));
    }

 private:
    // [begin:peel]
    const ShadowMap& peel(const Frame& frame, const LightSight& first, const DepthErrors& errors,
                          const CasterDraw& draw) {
        ShadowMap& second = pass_.options.provide(secondLayer_, frame.context->capabilities());
        peel_->setTexture("uFirstLayer", GL_TEXTURE_2D, first.map.texture());
        peel_->set("uFarther", first.frustum.range == DepthRange::reversed ? -1.0f : 1.0f);
        peel_->set("uQuantum", errors.quantum);
        second.render(*peel_, frame, first.light, first.frustum, draw);
        return second;
    }
    // [end:peel]

    Program& program(BiasMethod method) {
        const auto found = biased_.find(method);
        if (found != biased_.end()) return found->second;
        return biased_
            .emplace(method, Program("02_shadow_test/shadowed.vert", "03_polygon_offset/biased.frag",
                                     biasDefines(method)))
            .first->second;
    }

    void setBias(Program& biased, const DepthErrors& errors, const ShadowMap& second,
                 const LightFrustum& frustum) {
        biased.setTexture("uSecondLayer", GL_TEXTURE_2D, second.texture());
        biased.set("uBias", bias_);
        biased.set("uConstantBias", constantBias(frustum, second.size()));
        setDepthErrors(biased, errors, frustum);
    }

    LightPass pass_;
    std::string outside_ = "lit", method_ = "slope";
    float bias_ = 1.0f;
    std::optional<Program> peel_;
    std::map<BiasMethod, Program> biased_;  ///< one for each method in use
    std::optional<ShadowMap> secondLayer_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{"03_polygon_offset",
                           "bias against acne, leaks against bias: a bound derived, not tuned",
                           shadowViews("S(x)", "S(x): 1 where the light sees the point")};
    return runChapter<PolygonOffset>(info, argc, argv);
}
