// Chapter 05: fewer taps, stratified on a disk.
//
// A square of 15 x 15 texels takes 225 tests, and its shadows have corners. N tests spread over a disk of any
// radius do: how well depends on the pattern. It is the same for every pixel here, so what it misses shows as
// bands; chapter 06 turns the bands into noise.
#include "chapters/02_shadow_test/shadow_test.h"
#include "chapters/04_pcf/filter_truth.h"
#include "chapters/04_pcf/receiver_bias.h"
#include "chapters/05_jittered_disk/disk_pattern.h"
#include "chapters/05_jittered_disk/pattern_texture.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class JitteredDisk : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        pass_.options.fit = "view";  // a kernel is so many texels wide: texels as fine as can be
        pass_.options.declare(parameters);
        declareOutside(parameters, outside_);
        parameters.add("radius", radius_, 0.0f, 64.0f, "texels",
                       "of the disk; 0: the staircase of one test, 64: soft, and contacts are blurred");
        parameters.add("samples", samples_, 4, 1024, "", "tests on the disk; 4: bands, 1024: smooth, slow");
        parameters.add("pattern", pattern_, squarePatternNames(), "how the tests are spread over a square");
        parameters.add("disk-map", diskMap_, diskMapNames(),
                       "how the square becomes a disk; polar-linear: wrong at any number of samples");
        bias_.declare(parameters);
    }

    void load(const Scene&, const Context*) override {
        pass_.load();
        filtered_.emplace("02_shadow_test/shadowed.vert", "05_jittered_disk/filtered.frag");
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01).
        const LightSight sight = pass_.render(frame);

        // Pass 2: the picture, every fragment tested N times.
        const PassScope scope(frame.passTimer, "shading");
        if (frame.view == "depth") return pass_.show(frame, sight);
        clearPicture(frame, pass_.options);
        glEnable(GL_DEPTH_TEST);
        setPicture(*filtered_, frame, pass_.options, sight, outside_);
        bias_.set(*filtered_, sight.map, sight.frustum, frame.scene);
        setPattern(frame.seed);
        filtered_->set("uView", viewNumber(frame.view));
        drawPicture(*filtered_, frame);
        // [end:passes]
        frame.work["tests_per_pixel"] = samples_;
    }

    TruthImage truth(const TruthRequest& request) override {
        requireVisibility(request, "05");
        return filterTruth(request, pass_.options,
                           {FilterKernel::Shape::disk, radius_, pass_.options.mapSize});
    }

    std::optional<TruthImage> areaLightTruth(const TruthRequest& request) override {
        return penumbra::areaLightTruth(request, pass_.options);
    }

    std::vector<Program*> programs() override { return pass_.programs({&*filtered_}); }

 private:
    // [begin:pattern]
    void setPattern(std::uint32_t seed) {
        auto points = diskPattern(squarePattern(pattern_), diskMap(diskMap_), samples_, seed);
        if (!uploaded_ || points != points_) uploaded_.emplace(points_ = std::move(points));
        filtered_->setTexture("uPattern", GL_TEXTURE_2D, uploaded_->id());
        filtered_->set("uSamples", samples_);
        filtered_->set("uRadius", radius_);
    }
    // [end:pattern]

    LightPass pass_;
    std::string outside_ = "lit", pattern_ = "jittered", diskMap_ = "concentric";
    int samples_ = 16;
    float radius_ = 8.0f;
    ReceiverBias bias_{.receiverPlane = true};
    std::vector<glm::dvec2> points_;  // that uploaded_ holds
    std::optional<Program> filtered_;
    std::optional<PatternTexture> uploaded_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{"05_jittered_disk",
                           "fewer taps, stratified on a disk: what a pattern misses shows as bands",
                           shadowViews("the filtered S(x)", "filtered S(x): 0 dark to 1 lit")};
    return runChapter<JitteredDisk>(info, argc, argv);
}
