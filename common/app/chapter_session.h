// A chapter with all it needs to draw: scene, context, GPU scene. Made once, then asked for frames, by the
// headless loop and by the window alike.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "common/app/chapter.h"
#include "common/app/command_line.h"
#include "common/gl/render_target.h"

namespace penumbra {

/// Where the frame goes and how: what differs from one frame of a session to the next.
struct FrameRequest {
    std::string view;
    Camera camera;
    glm::ivec2 size{0};
    std::uint32_t framebuffer = 0;  ///< unused by a CPU chapter
    bool renderMapsAgain = false;
    PassTimer* passTimer = nullptr;
};

/// The context that these options ask for; `headless`: never a window.
ContextRequest contextRequest(const ChapterInfo& info, const Options& options, bool headless);

class ChapterSession {
 public:
    /// Loads scene and chapter. Makes the context unless the chapter needs none; `headless`: never a window.
    ChapterSession(const ChapterInfo& info, std::unique_ptr<Chapter> chapter, Parameters& parameters,
                   const Options& options, bool headless, ProgressCallback progress);
    ~ChapterSession();
    ChapterSession(const ChapterSession&) = delete;
    ChapterSession& operator=(const ChapterSession&) = delete;

    /// Draws one frame into `request.framebuffer` (bound, with the viewport set), or into `cpuPicture()`;
    /// clears the work counters first.
    void render(const FrameRequest& request);
    /// The same off screen, whatever `request.framebuffer` says: into a target of its own, kept between
    /// calls.
    void renderOffScreen(FrameRequest request);
    /// The frame of the latest `renderOffScreen`: 1 channel for scalar views, else 3; top row first, linear.
    FloatImage readBack(const std::string& view) const;
    /// Both.
    FloatImage picture(const FrameRequest& request);

    const ChapterInfo& info() const { return info_; }
    Chapter& chapter() { return *chapter_; }
    Parameters& parameters() { return parameters_; }
    const Options& options() const { return options_; }
    const Scene& scene() const { return scene_; }
    const Camera& camera() const { return scene_.cameras[std::size_t(options_.camera)]; }  ///< the chosen one
    Context* context() const { return context_.get(); }  ///< null for a CPU chapter
    const WorkCounters& work() const { return work_; }   ///< of the latest frame
    const FloatImage& cpuPicture() const { return cpuPicture_; }
    const ProgressCallback& progress() const { return progress_; }

    /// Info of a view by name; UsageError with the nearest name if there is none.
    const ViewInfo& view(const std::string& name) const;
    /// What the picture is multiplied by before tone mapping: the scene's exposure for the light that
    /// parameter "light" selects (all lights without such a parameter), times 2^EV, times the view's
    /// exposureScale. 0: not tone-mapped.
    float exposureOf(const ViewInfo& view) const;
    /// What a screen can show, 1 or 3 channels in [0,1], linear: tone-mapped, grey or in false colour, as the
    /// view says.
    FloatImage display(const FloatImage& picture, const ViewInfo& view) const;
    /// Of a false-colour view: the values that the darkest and the brightest colour stand for.
    static std::pair<float, float> colourRange(const FloatImage& picture);

 private:
    std::unique_ptr<RenderTarget> makeTarget(const glm::ivec2& size);

    const ChapterInfo& info_;
    Parameters& parameters_;
    const Options& options_;
    ProgressCallback progress_;
    WorkCounters work_;
    FloatImage cpuPicture_;
    // Destroyed from the last to the first: the chapter's and the scene's GL objects before the context they
    // live in.
    Scene scene_;
    std::unique_ptr<Context> context_;
    std::unique_ptr<GpuScene> gpu_;
    std::unique_ptr<RenderTarget> target_;
    std::unique_ptr<Chapter> chapter_;
};

}  // namespace penumbra
