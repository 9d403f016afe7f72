// Chapter 06: a different pattern for every pixel.
//
// One pattern for all pixels misses the same things everywhere, and what it misses shows as bands. Give every
// pixel its own stratified pattern, and the same error becomes noise, which the eye forgives. The patterns
// lie in a small 3D texture that is tiled over the picture: a column of it for each pixel.
#include "chapters/01_depth_from_light/depth_view.h"
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
        options_.fit = "view";  // a kernel is so many texels wide: texels as fine as can be
        options_.declare(parameters);
        declareOutside(parameters, outside_);
        jitter_.declare(parameters);
    }

    void load(const Scene&, const Context*) override {
        depth_.emplace("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
        jittered_.emplace("02_shadow_test/shadowed.vert", "06_jitter_texture/jittered.frag");
        depthView_.emplace();
        jitter_.reset();
        map_.reset();
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01).
        ShadowMap& map = options_.provide(map_, frame.context->capabilities());
        const Light& light = options_.chosenLight(frame.scene);
        const LightFrustum& frustum = options_.frustum(frame, map);
        map.render(*depth_, frame, light, frustum);

        // Pass 2: the picture, every fragment tested with the pattern of its pixel.
        const PassScope scope(frame.passTimer, "shading");
        clearPicture(frame, options_);
        if (frame.view == "depth") return depthView_->draw(frame, map, frustum, false);
        glEnable(GL_DEPTH_TEST);
        Program& jittered = jittered_->with(jitter_.defines(viewNumber(frame.view)));
        setCameraAndLight(jittered, frame, options_);
        setShadowMap(jittered, map, frustum, light, outside_);
        jitter_.set(jittered, map, frustum, frame);
        drawPicture(jittered, frame);
        // [end:passes]
        frame.work["tests_per_pixel"] = jitter_.samples;
    }

    TruthImage truth(const TruthRequest& request) override {
        if (request.view != "visibility")
            throw UsageError("--compare-truth: chapter 06 has an exact answer for --view visibility");
        return filterTruth(request, options_, {FilterKernel::Shape::disk, jitter_.radius, options_.mapSize});
    }

    std::optional<TruthImage> areaLightTruth(const TruthRequest& request) override {
        return penumbra::areaLightTruth(request, options_);
    }

    std::vector<Program*> programs() override {
        std::vector<Program*> all = jittered_->compiled();
        all.insert(all.end(), {&*depth_, &depthView_->program()});
        return all;
    }

 private:
    static int viewNumber(const std::string& view) {
        return view == "visibility" ? 1 : view == "shadow-kind" ? 2 : 0;
    }

    ShadowOptions options_;
    std::string outside_ = "lit";
    JitterOptions jitter_;
    std::optional<Program> depth_;
    std::optional<ProgramVariants> jittered_;
    std::optional<DepthView> depthView_;
    std::optional<ShadowMap> map_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "06_jitter_texture",
        "a different pattern for every pixel: bands become noise",
        {{"color", "Blinn-Phong with the filtered S(x)"},
         {"visibility", "filtered S(x): 0 dark to 1 lit", true, false},
         {"shadow-kind", "lit white, attached shadow blue, cast shadow red", false, false, 0.0},
         {"depth", "the shadow map", true, false}}};
    return runChapter<JitterTextureChapter>(info, argc, argv);
}
