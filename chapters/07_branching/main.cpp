// Chapter 07: work only where there is a penumbra.
//
// Most of a picture is fully lit or fully dark, and 64 tests say so 64 times. The lecture takes eight first,
// and the others only where those disagree; but eight tests miss a wire that lies between them. The minimum
// and the maximum of the map around a point miss nothing: the picture is chapter 06's, bit for bit.
#include "chapters/01_depth_from_light/depth_view.h"
#include "chapters/02_shadow_test/shadow_test.h"
#include "chapters/04_pcf/filter_truth.h"
#include "chapters/06_jitter_texture/program_variants.h"
#include "chapters/07_branching/branching_options.h"
#include "common/app/pass_timer.h"
#include "common/error.h"
#include "common/scene/light.h"

using namespace penumbra;

namespace {

class Branching : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        options_.fit = "view";  // a kernel is so many texels wide: texels as fine as can be
        options_.declare(parameters);
        declareOutside(parameters, outside_);
        branching_.declare(parameters);
        parameters_ = &parameters;
    }

    void load(const Scene& scene, const Context*) override {
        depth_.emplace("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
        branched_.emplace("02_shadow_test/shadowed.vert", "07_branching/branching.frag");
        depthView_.emplace();
        count_.emplace();
        branching_.load(scene);
        map_.reset();
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01).
        ShadowMap& map = options_.provide(map_, frame.context->capabilities());
        const Light& light = options_.chosenLight(frame.scene);
        const LightFrustum& frustum = options_.frustum(frame, map);
        map.render(*depth_, frame, light, frustum);
        if (frame.view == "depth") return showDepth(frame, map, frustum);

        // Pass 1b: minimum and maximum around each texel, when the map is new.
        Program& branched = branched_->with(branching_.defines(viewNumber(frame.view)));
        branching_.set(branched, map, frustum, light, frame);

        // Pass 2: the picture, all taps only where they may disagree.
        setCameraAndLight(branched, frame, options_);
        setShadowMap(branched, map, frustum, light, outside_);
        branched.set("uRed", 1.0f / exposure(frame.scene, options_.light));
        countWork(frame, map, frustum);
        const PassScope scope(frame.passTimer, "shading");
        clearPicture(frame, options_);
        glEnable(GL_DEPTH_TEST);
        drawPicture(branched, frame);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        if (request.view != "visibility")
            throw UsageError("--compare-truth: chapter 07 has an exact answer for --view visibility");
        if (branching_.hardening())  // it estimates the area light itself
            return visibilityTruth(request.scene, request.tracer, request.camera,
                                   options_.chosenLight(request.scene), request.size, false,
                                   request.progress);
        return filterTruth(request, options_,
                           {FilterKernel::Shape::disk, branching_.jitter.radius, options_.mapSize});
    }

    std::optional<TruthImage> areaLightTruth(const TruthRequest& request) override {
        if (branching_.hardening()) return std::nullopt;
        return penumbra::areaLightTruth(request, options_);
    }

    std::vector<Program*> programs() override {
        std::vector<Program*> all = branched_->compiled(), built = branching_.programs();
        all.insert(all.end(), built.begin(), built.end());
        all.insert(all.end(), {&*depth_, &depthView_->program()});
        return all;
    }

 private:
    static int viewNumber(const std::string& view) {
        return view == "visibility" ? 1 : view == "shadow-kind" ? 2 : view == "work" ? 3 : 0;
    }

    void showDepth(const Frame& frame, const ShadowMap& map, const LightFrustum& frustum) {
        clearPicture(frame, options_);
        depthView_->draw(frame, map, frustum, false);
    }

    /// In a frame in which something changed only; not part of the shading pass.
    void countWork(const Frame& frame, const ShadowMap& map, const LightFrustum& frustum) {
        const glm::dmat4 seen = clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y);
        std::string state = parameters_->toJson(true) + std::to_string(frame.seed);
        state.append(reinterpret_cast<const char*>(&seen), sizeof seen);
        const PixelCounts& counted = count_->count(frame, state, [&] {
            Program& flags = branched_->with(branching_.defines(4));
            const Light& light = options_.chosenLight(frame.scene);
            branching_.set(flags, map, frustum, light, frame);
            setCameraAndLight(flags, frame, options_);
            setShadowMap(flags, map, frustum, light, outside_);
            frame.gpu->drawShaded(flags, allClusters(frame.scene));
        });
        branching_.count(counted, frame.work);
    }

    ShadowOptions options_;
    std::string outside_ = "lit";
    BranchingOptions branching_;
    Parameters* parameters_ = nullptr;
    std::optional<Program> depth_;
    std::optional<ProgramVariants> branched_;
    std::optional<DepthView> depthView_;
    std::optional<WorkCount> count_;
    std::optional<ShadowMap> map_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "07_branching",
        "probe first: only the penumbra is supersampled",
        {{"color", "Blinn-Phong with the filtered S(x)"},
         {"visibility", "filtered S(x): 0 dark to 1 lit", true, false},
         {"work", "the picture, red where all taps were taken"},
         {"shadow-kind", "lit white, attached shadow blue, cast shadow red", false, false, 0.0},
         {"depth", "the shadow map", true, false}}};
    return runChapter<Branching>(info, argc, argv);
}
