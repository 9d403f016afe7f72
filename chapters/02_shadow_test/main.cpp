// Chapter 02: S(x), the shadow test.
//
// Pass 1 keeps the depth nearest to the light (chapter 01). Pass 2 draws the picture, carries each point to
// the light's coordinates, and compares: farther than what the light sees there means in shadow. Depths are
// compared as they are, without a bias, so lit surfaces shadow themselves in stripes: acne. Chapter 03
// removes it.
#include "chapters/01_depth_from_light/depth_view.h"
#include "chapters/02_shadow_test/shadow_test.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class ShadowTest : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        options_.declare(parameters);
        declareOutside(parameters, outside_);
    }

    void load(const Scene&, const Context*) override {
        depth_.emplace("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
        shadowed_.emplace("02_shadow_test/shadowed.vert", "02_shadow_test/shadowed.frag");
        depthView_.emplace();
        map_.reset();
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light, depth alone (chapter 01).
        ShadowMap& map = options_.provide(map_, frame.context->capabilities());
        const Light& light = options_.chosenLight(frame.scene);
        const LightFrustum& frustum = options_.frustum(frame, map);
        map.render(*depth_, frame, light, frustum);

        // Pass 2: the picture, each fragment compared with the map.
        const PassScope scope(frame.passTimer, "shading");
        clearPicture(frame, options_);
        if (frame.view == "depth") return depthView_->draw(frame, map, frustum, false);
        glEnable(GL_DEPTH_TEST);
        setCameraAndLight(*shadowed_, frame, options_);
        setShadowMap(*shadowed_, map, frustum, light, outside_);
        shadowed_->set("uView", frame.view == "visibility" ? 1 : frame.view == "shadow-kind" ? 2 : 0);
        drawPicture(*shadowed_, frame);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        if (request.view != "visibility")
            throw UsageError("--compare-truth: chapter 02 has an exact answer for --view visibility");
        return visibilityTruth(request.scene, request.tracer, request.camera,
                               options_.chosenLight(request.scene), request.size, true, request.progress);
    }

    std::vector<Program*> programs() override { return {&*depth_, &*shadowed_, &depthView_->program()}; }

 private:
    ShadowOptions options_;
    std::string outside_ = "lit";
    std::optional<Program> depth_, shadowed_;
    std::optional<DepthView> depthView_;
    std::optional<ShadowMap> map_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "02_shadow_test",
        "S(x): compare the point's depth with the map's",
        {{"color", "Blinn-Phong with S(x), ambient only in shadow"},
         {"visibility", "S(x): 1 where the light sees the point", true, false},
         {"shadow-kind", "lit white, attached shadow blue, cast shadow red", false, false, 0.0},
         {"depth", "the shadow map", true, false}}};
    return runChapter<ShadowTest>(info, argc, argv);
}
