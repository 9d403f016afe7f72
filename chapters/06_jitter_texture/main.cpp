// Chapter 06: a different pattern for every pixel.
//
// One pattern for all pixels misses the same things everywhere, and what it misses shows as bands. Give every
// pixel its own stratified pattern, and the same error becomes noise, which the eye forgives. The patterns
// lie in a small 3D texture that is tiled over the picture: a column of it for each pixel.
#include "chapters/02_shadow_test/shadow_test.h"
#include "chapters/04_pcf/filter_truth.h"
#include "chapters/06_jitter_texture/jitter_options.h"
#include "chapters/06_jitter_texture/program_variants.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class JitterTextureChapter : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        pass_.options.fit = "view";  // a kernel is so many texels wide: texels as fine as can be
        pass_.options.declare(parameters);
        declareOutside(parameters, outside_);
        jitter_.declare(parameters);
    }

    void load(const Scene&, const Context*) override {
        pass_.load();
        jittered_.emplace("02_shadow_test/shadowed.vert", "06_jitter_texture/jittered.frag");
        jitter_.reset();
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01).
        const LightSight sight = pass_.render(frame);

        // Pass 2: the picture, every fragment tested with the pattern of its pixel.
        const PassScope scope(frame.passTimer, "shading");
        if (frame.view == "depth") return pass_.show(frame, sight);
        clearPicture(frame, pass_.options);
        glEnable(GL_DEPTH_TEST);
        Program& jittered = jittered_->with(jitter_.defines(viewNumber(frame.view)));
        setPicture(jittered, frame, pass_.options, sight, outside_);
        jitter_.set(jittered, sight.map, sight.frustum, frame);
        drawPicture(jittered, frame);
        // [end:passes]
        frame.work["tests_per_pixel"] = jitter_.samples;
    }

    TruthImage truth(const TruthRequest& request) override {
        requireVisibility(request, "06");
        return filterTruth(request, pass_.options,
                           {FilterKernel::Shape::disk, jitter_.radius, pass_.options.mapSize});
    }

    std::optional<TruthImage> areaLightTruth(const TruthRequest& request) override {
        return penumbra::areaLightTruth(request, pass_.options);
    }

    std::vector<Program*> programs() override { return pass_.programs(jittered_->compiled()); }

 private:
    LightPass pass_;
    std::string outside_ = "lit";
    JitterOptions jitter_;
    std::optional<ProgramVariants> jittered_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{"06_jitter_texture", "a different pattern for every pixel: bands become noise",
                           shadowViews("the filtered S(x)", "filtered S(x): 0 dark to 1 lit")};
    return runChapter<JitterTextureChapter>(info, argc, argv);
}
