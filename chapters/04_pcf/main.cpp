// Chapter 04: filter the tests, not the depths.
//
// The staircase of a shadow's edge is a texture seen too large, and textures are filtered. But a mean of
// depths is the depth of nothing. Percentage-closer filtering tests first: n x n neighbouring texels each say
// lit or dark, and the share of those that say lit is the visibility. The edge becomes a ramp n texels wide.
#include "chapters/01_depth_from_light/depth_view.h"
#include "chapters/02_shadow_test/shadow_test.h"
#include "chapters/04_pcf/compare_sampler.h"
#include "chapters/04_pcf/filter_truth.h"
#include "chapters/04_pcf/receiver_bias.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class Pcf : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        options_.fit = "view";  // a kernel is so many texels wide: texels as fine as can be
        options_.declare(parameters);
        declareOutside(parameters, outside_);
        parameters.add("kernel-width", kernelWidth_, 1, 15, "texels",
                       "n of the n x n tests; 1: the staircase, 15: soft, slow, and contacts are blurred");
        parameters.add("bilinear", bilinear_,
                       "each test is four, blended by the sampler: no steps in the ramp");
        parameters.add("filter", filter_, {"tests", "depths"},
                       "what is averaged; depths: still a hard edge, and a wrong one (never bilinear)");
        bias_.declare(parameters);
    }

    void load(const Scene&, const Context*) override {
        depth_.emplace("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
        filtered_.emplace("02_shadow_test/shadowed.vert", "04_pcf/filtered.frag");
        depthView_.emplace();
        map_.reset();
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01).
        ShadowMap& map = options_.provide(map_, frame.context->capabilities());
        const Light& light = options_.chosenLight(frame.scene);
        const LightFrustum& frustum = options_.frustum(frame, map);
        map.render(*depth_, frame, light, frustum);

        // Pass 2: the picture, every fragment tested against n x n texels.
        const PassScope scope(frame.passTimer, "shading");
        clearPicture(frame, options_);
        if (frame.view == "depth") return depthView_->draw(frame, map, frustum, false);
        glEnable(GL_DEPTH_TEST);
        setCameraAndLight(*filtered_, frame, options_);
        setShadowMap(*filtered_, map, frustum, light, outside_);
        bias_.set(*filtered_, map, frustum, frame.scene);
        setFilter(map);
        filtered_->set("uView", frame.view == "visibility" ? 1 : frame.view == "shadow-kind" ? 2 : 0);
        drawPicture(*filtered_, frame);
        // [end:passes]
        frame.work["tests_per_pixel"] = kernelWidth_ * kernelWidth_;
    }

    TruthImage truth(const TruthRequest& request) override {
        if (request.view != "visibility")
            throw UsageError("--compare-truth: chapter 04 has an exact answer for --view visibility");
        return filterTruth(request, options_,
                           {FilterKernel::Shape::square, double(kernelWidth_), options_.mapSize});
    }

    std::optional<TruthImage> areaLightTruth(const TruthRequest& request) override {
        return penumbra::areaLightTruth(request, options_);
    }

    std::vector<Program*> programs() override { return {&*depth_, &*filtered_, &depthView_->program()}; }

 private:
    // [begin:filter]
    void setFilter(const ShadowMap& map) {
        const DepthRange range = depthRange(map.format());
        std::optional<CompareSampler>& compare = range == DepthRange::reversed ? compareReversed_ : compare_;
        if (!compare) compare.emplace(range);
        // The same texture twice: as numbers, and through a comparison.
        filtered_->setTexture("uShadowCompare", GL_TEXTURE_2D, map.texture(), compare->id());
        filtered_->set("uKernelWidth", kernelWidth_);
        filtered_->set("uBilinear", bilinear_);
        filtered_->set("uFilterDepths", filter_ == "depths");
    }
    // [end:filter]

    ShadowOptions options_;
    std::string outside_ = "lit", filter_ = "tests";
    int kernelWidth_ = 3;
    bool bilinear_ = false;
    ReceiverBias bias_;
    std::optional<Program> depth_, filtered_;
    std::optional<DepthView> depthView_;
    std::optional<CompareSampler> compare_, compareReversed_;
    std::optional<ShadowMap> map_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "04_pcf",
        "filter the tests, not the depths: the share of n x n texels that are lit",
        {{"color", "Blinn-Phong with the filtered S(x)"},
         {"visibility", "filtered S(x): 0 dark to 1 lit", true, false},
         {"shadow-kind", "lit white, attached shadow blue, cast shadow red", false, false, 0.0},
         {"depth", "the shadow map", true, false}}};
    return runChapter<Pcf>(info, argc, argv);
}
