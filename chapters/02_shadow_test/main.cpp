// Chapter 02: S(x), the shadow test.
//
// Pass 1 keeps the depth nearest to the light (chapter 01). Pass 2 draws the picture, carries each point to
// the light's coordinates, and compares: farther than what the light sees there means in shadow. Depths are
// compared as they are, without a bias, so lit surfaces shadow themselves in stripes: acne. Chapter 03
// removes it.
#include "chapters/02_shadow_test/shadow_test.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class ShadowTest : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        pass_.options.declare(parameters);
        declareOutside(parameters, outside_);
    }

    void load(const Scene&, const Context*) override {
        pass_.load();
        shadowed_.emplace("02_shadow_test/shadowed.vert", "02_shadow_test/shadowed.frag");
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light, depth alone (chapter 01).
        const LightSight sight = pass_.render(frame);

        // Pass 2: the picture, each fragment compared with the map.
        const PassScope scope(frame.passTimer, "shading");
        if (frame.view == "depth") return pass_.show(frame, sight);
        clearPicture(frame, pass_.options);
        glEnable(GL_DEPTH_TEST);
        setPicture(*shadowed_, frame, pass_.options, sight, outside_);
        shadowed_->set("uView", viewNumber(frame.view));
        drawPicture(*shadowed_, frame);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        requireVisibility(request, "02");
        return visibilityTruth(request.scene, request.tracer, request.camera,
                               pass_.options.chosenLight(request.scene), request.size, true,
                               request.progress);
    }

    std::vector<Program*> programs() override { return pass_.programs({&*shadowed_}); }

 private:
    LightPass pass_;
    std::string outside_ = "lit";
    std::optional<Program> shadowed_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "02_shadow_test", "S(x): compare the point's depth with the map's",
        shadowViews("S(x), ambient only in shadow", "S(x): 1 where the light sees the point")};
    return runChapter<ShadowTest>(info, argc, argv);
}
