// Chapter 01: what does the light see?
//
// A point is lit when the light sees it. So draw the scene from the light and keep, for each texel, the depth
// of what is nearest: the shadow map (Williams 1978). Nothing is in shadow yet; this chapter is about the
// depths being right.
#include "chapters/01_depth_from_light/depth_truth.h"
#include "chapters/01_depth_from_light/light_pass.h"
#include "common/app/pass_timer.h"
#include "common/error.h"

using namespace penumbra;

namespace {

class DepthFromLight : public Chapter {
 public:
    void declare(Parameters& parameters) override { pass_.options.declare(parameters); }

    void load(const Scene&, const Context*) override {
        pass_.load();
        lit_.emplace("01_depth_from_light/lit.vert", "01_depth_from_light/lit.frag");
    }

    void render(const Frame& frame) override {
        // [begin:passes]
        // Pass 1: the scene from the light, depth alone.
        const LightSight sight = pass_.render(frame);

        // Pass 2: the picture. Without shadows, from the camera or from the light, or the map itself.
        const PassScope scope(frame.passTimer, "shading");
        if (frame.view == "color")
            drawFromCamera(frame);
        else if (frame.view == "light-view")
            drawFromLight(frame, sight.frustum);
        else
            pass_.show(frame, sight, frame.view == "linear-depth");
        // [end:passes]
    }

    TruthImage truth(const TruthRequest& request) override {
        if (request.view != "depth" && request.view != "linear-depth")
            throw UsageError(
                "--compare-truth: chapter 01 has an exact answer for --view depth and linear-depth");
        const DepthFormat format = depthFormat(pass_.options.depthFormat, request.context->capabilities());
        const Light& light = pass_.options.chosenLight(request.scene);
        const LightFrustum& frustum =
            pass_.options.frustum(request.scene, request.camera, request.size, format);
        return depthTruth(request.tracer, frustum, request.size, pass_.options.mapSize, format, light.part,
                          request.view == "linear-depth", request.progress);
    }

    std::vector<Program*> programs() override { return pass_.programs({&*lit_}); }

 private:
    void drawFromCamera(const Frame& frame) {
        clearPicture(frame, pass_.options);
        glEnable(GL_DEPTH_TEST);
        setCameraAndLight(*lit_, frame, pass_.options);
        drawPicture(*lit_, frame);
    }

    /// The same picture with the light as the camera: whatever is missing here is in shadow.
    void drawFromLight(const Frame& frame, LightFrustum frustum) {
        clearPicture(frame, pass_.options);
        frustum.range = DepthRange::standard;
        const int side = std::min(frame.size.x, frame.size.y);
        glViewport((frame.size.x - side) / 2, (frame.size.y - side) / 2, side, side);
        glEnable(GL_DEPTH_TEST);
        setCameraAndLight(*lit_, frame, pass_.options);
        lit_->set("uClipFromWorld", glm::mat4(frustum.clipFromWorld()));
        frame.gpu->drawShaded(*lit_, visibleClusters(frame.scene, Frustum(frustum.clipFromWorld())));
        glViewport(0, 0, frame.size.x, frame.size.y);
    }

    LightPass pass_;
    std::optional<Program> lit_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{"01_depth_from_light",
                           "the light's depth map: 16, 24 and 32F bits, perspective and orthographic",
                           {{"color", "the scene lit, without shadows"},
                            {"depth", "the map: window depth, near 0, far 1", true, false},
                            {"linear-depth", "the map in metres along the light's axis", true, true},
                            {"light-view", "the scene as the light sees it"}}};
    return runChapter<DepthFromLight>(info, argc, argv);
}
