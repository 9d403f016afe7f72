// Chapter 04: filter the tests, not the depths.
//
// The staircase of a shadow's edge is a texture seen too large, and textures are filtered. But a mean of
// depths is the depth of nothing. Percentage-closer filtering tests first: n x n neighbouring texels each say
// lit or dark, and the share of those that say lit is the visibility. The edge becomes a ramp n texels wide.
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
        pass_.options.fit = "view";  // a kernel is so many texels wide: texels as fine as can be
        pass_.options.declare(parameters);
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
        pass_.load();
        filtered_.emplace("02_shadow_test/shadowed.vert", "04_pcf/filtered.frag");
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01).
        const LightSight sight = pass_.render(frame);

        // Pass 2: the picture, every fragment tested against n x n texels.
        const PassScope scope(frame.passTimer, "shading");
        if (frame.view == "depth") return pass_.show(frame, sight);
        clearPicture(frame, pass_.options);
        glEnable(GL_DEPTH_TEST);
        setPicture(*filtered_, frame, pass_.options, sight, outside_);
        bias_.set(*filtered_, sight.map, sight.frustum, frame.scene);
        setFilter(sight.map);
        filtered_->set("uView", viewNumber(frame.view));
        drawPicture(*filtered_, frame);
        // [end:passes]
        frame.work["tests_per_pixel"] = kernelWidth_ * kernelWidth_;
    }

    TruthImage truth(const TruthRequest& request) override {
        requireVisibility(request, "04");
        return filterTruth(request, pass_.options,
                           {FilterKernel::Shape::square, double(kernelWidth_), pass_.options.mapSize});
    }

    std::optional<TruthImage> areaLightTruth(const TruthRequest& request) override {
        return penumbra::areaLightTruth(request, pass_.options);
    }

    std::vector<Program*> programs() override { return pass_.programs({&*filtered_}); }

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

    LightPass pass_;
    std::string outside_ = "lit", filter_ = "tests";
    int kernelWidth_ = 3;
    bool bilinear_ = false;
    ReceiverBias bias_;
    std::optional<Program> filtered_;
    std::optional<CompareSampler> compare_, compareReversed_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{"04_pcf",
                           "filter the tests, not the depths: the share of n x n texels that are lit",
                           shadowViews("the filtered S(x)", "filtered S(x): 0 dark to 1 lit")};
    return runChapter<Pcf>(info, argc, argv);
}
