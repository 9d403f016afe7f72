// Chapter 07: work only where there is a penumbra.
//
// Most of a picture is fully lit or fully dark, and 64 tests say so 64 times. The lecture takes eight first,
// and the others only where those disagree; but eight tests miss a wire that lies between them. The minimum
// and the maximum of the map around a point miss nothing: the picture is chapter 06's, bit for bit.
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
        pass_.options.fit = "view";  // a kernel is so many texels wide: texels as fine as can be
        pass_.options.declare(parameters);
        declareOutside(parameters, outside_);
        branching_.declare(parameters);
        parameters_ = &parameters;
    }

    void load(const Scene& scene, const Context*) override {
        pass_.load();
        branched_.emplace("02_shadow_test/shadowed.vert", "07_branching/branching.frag");
        count_.emplace();
        branching_.load(scene);
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light (chapter 01).
        const LightSight sight = pass_.render(frame);
        if (frame.view == "depth") return pass_.show(frame, sight);

        // Pass 1b: minimum and maximum around each texel, when the map is new.
        Program& branched = prepared(viewOrWork(frame.view), frame, sight);
        countWork(frame, sight);

        // Pass 2: the picture, all taps only where they may disagree.
        const PassScope scope(frame.passTimer, "shading");
        clearPicture(frame, pass_.options);
        glEnable(GL_DEPTH_TEST);
        drawPicture(branched, frame);
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        requireVisibility(request, "07");
        if (branching_.hardening())  // it estimates the area light itself
            return visibilityTruth(request.scene, request.tracer, request.camera,
                                   pass_.options.chosenLight(request.scene), request.size, false,
                                   request.progress);
        return filterTruth(request, pass_.options,
                           {FilterKernel::Shape::disk, branching_.jitter.radius, pass_.options.mapSize});
    }

    std::optional<TruthImage> areaLightTruth(const TruthRequest& request) override {
        if (branching_.hardening()) return std::nullopt;
        return penumbra::areaLightTruth(request, pass_.options);
    }

    std::vector<Program*> programs() override {
        std::vector<Program*> all = branched_->compiled(), built = branching_.programs();
        all.insert(all.end(), built.begin(), built.end());
        return pass_.programs(std::move(all));
    }

 private:
    static int viewOrWork(const std::string& view) { return view == "work" ? 3 : viewNumber(view); }

    /// branching.frag for `view`, its uniforms set; makes the minimum-maximum map that it reads.
    Program& prepared(int view, const Frame& frame, const LightSight& sight) {
        Program& program = branched_->with(branching_.defines(view));
        branching_.set(program, sight.map, sight.frustum, sight.light, frame);
        setPicture(program, frame, pass_.options, sight, outside_);
        program.set("uRed", 1.0f / exposure(frame.scene, pass_.options.light));
        return program;
    }

    /// In a frame in which something changed only; not part of the shading pass.
    void countWork(const Frame& frame, const LightSight& sight) {
        const glm::dmat4 seen = clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y);
        std::string state = parameters_->toJson(true) + std::to_string(frame.seed);
        state.append(reinterpret_cast<const char*>(&seen), sizeof seen);
        const PixelCounts& counted =
            count_->count(frame, state, [&]() -> Program& { return prepared(4, frame, sight); });
        branching_.count(counted, frame.work);
    }

    LightPass pass_;
    std::string outside_ = "lit";
    BranchingOptions branching_;
    Parameters* parameters_ = nullptr;
    std::optional<ProgramVariants> branched_;
    std::optional<WorkCount> count_;
};

}  // namespace

int main(int argc, char** argv) {
    std::vector<ViewInfo> views = shadowViews("the filtered S(x)", "filtered S(x): 0 dark to 1 lit");
    views.insert(views.begin() + 2, {"work", "the picture, red where all taps were taken"});
    const ChapterInfo info{"07_branching", "probe first: only the penumbra is supersampled", views, true,
                           80};  // the classification of each pixel too
    return runChapter<Branching>(info, argc, argv);
}
