// Chapter 03: bias against acne, leaks against bias.
//
// The map's depth was taken at the centre of a texel, the point is somewhere in it: on a slope the two
// differ, and the surface shadows itself. A bias hides the difference, and too much of it lets light leak
// under walls. How much is needed can be derived from the slope, the format and the arithmetic; `--method`
// compares that bound with the remedies in use.
#include "chapters/01_depth_from_light/depth_view.h"
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
        options_.declare(parameters);
        declareOutside(parameters, outside_);
        parameters.add("method", method_, biasMethodNames(), "remedy for acne; slope is the derived bound");
        parameters.add("bias", bias_, 0.0f, 32.0f, "",
                       "multiple of what the method asks for; 0: stripes of acne, 8: shadows detach");
    }

    void load(const Scene&, const Context*) override {
        depth_.emplace("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
        peel_.emplace("01_depth_from_light/depth.vert", "03_polygon_offset/peel.frag");
        biased_.clear();
        depthView_.emplace();
        map_.reset();
        secondLayer_.reset();
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01), drawn as the method wants it.
        const BiasMethod method = biasMethod(method_);
        ShadowMap& map = options_.provide(map_, frame.context->capabilities());
        const Light& light = options_.chosenLight(frame.scene);
        const LightFrustum& frustum = options_.frustum(frame, map);
        const DepthErrors errors = bothPassesErrors(map, frustum, frame.scene.bounds);
        const CasterDraw draw = casterDraw(method, map, frustum, errors, bias_);
        map.render(*depth_, frame, light, frustum, draw);

        // Pass 1b, midpoint only: what lies behind the nearest surface.
        const ShadowMap& second =
            method == BiasMethod::midpoint ? peel(frame, map, light, frustum, errors, draw) : map;

        // Pass 2: the picture, compared with a bias.
        const PassScope scope(frame.passTimer, "shading");
        clearPicture(frame, options_);
        if (frame.view == "depth") return depthView_->draw(frame, map, frustum, false);
        glEnable(GL_DEPTH_TEST);
        Program& biased = program(method);
        setCameraAndLight(biased, frame, options_);
        setShadowMap(biased, map, frustum, light, outside_);
        setBias(biased, errors, second, frustum);
        biased.set("uView", frame.view == "visibility" ? 1 : frame.view == "shadow-kind" ? 2 : 0);
        drawPicture(biased, frame);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        if (request.view != "visibility")
            throw UsageError("--compare-truth: chapter 03 has an exact answer for --view visibility");
        return visibilityTruth(request.scene, request.tracer, request.camera,
                               options_.chosenLight(request.scene), request.size, true, request.progress);
    }

    std::vector<Program*> programs() override {
        std::vector<Program*> all{&*depth_, &*peel_, &depthView_->program()};
        for (auto& [method, program] : biased_) all.push_back(&program);
        return all;
    }

 private:
    // [begin:peel]
    const ShadowMap& peel(const Frame& frame, const ShadowMap& first, const Light& light,
                          const LightFrustum& frustum, const DepthErrors& errors, const CasterDraw& draw) {
        ShadowMap& second = options_.provide(secondLayer_, frame.context->capabilities());
        peel_->setTexture("uFirstLayer", GL_TEXTURE_2D, first.texture());
        peel_->set("uFarther", frustum.range == DepthRange::reversed ? -1.0f : 1.0f);
        peel_->set("uQuantum", errors.quantum);
        second.render(*peel_, frame, light, frustum, draw);
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

    ShadowOptions options_;
    std::string outside_ = "lit", method_ = "slope";
    float bias_ = 1.0f;
    std::optional<Program> depth_, peel_;
    std::map<BiasMethod, Program> biased_;  ///< one for each method in use
    std::optional<DepthView> depthView_;
    std::optional<ShadowMap> map_, secondLayer_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "03_polygon_offset",
        "bias against acne, leaks against bias: a bound derived, not tuned",
        {{"color", "Blinn-Phong with S(x)"},
         {"visibility", "S(x): 1 where the light sees the point", true, false},
         {"shadow-kind", "lit white, attached shadow blue, cast shadow red", false, false, 0.0},
         {"depth", "the shadow map", true, false}}};
    return runChapter<PolygonOffset>(info, argc, argv);
}
