// What a chapter program is. `runChapter` gives it a window, a headless renderer, a test subject and a
// benchmark.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/app/parameters.h"
#include "common/app/pass_timer.h"
#include "common/gl/context.h"
#include "common/image/image.h"
#include "common/scene/gpu_scene.h"
#include "common/scene/scene.h"
#include "common/truth/truth_image.h"

namespace penumbra {

/// Named counters of the report's "work" object, e.g. shadow_maps_rendered. Of one frame: cleared before
/// each. One whose name ends in _left counts what a picture that is refined from frame to frame still lacks:
/// while it is above 0, a window goes on drawing.
using WorkCounters = std::map<std::string, std::int64_t>;

struct ViewInfo {
    std::string name;     ///< "color", "visibility", "depth", ...
    std::string help;     ///< what the picture shows
    bool scalar = false;  ///< 1 channel: shown as grey (or false colour), stored as one channel
    bool falseColour = false;
    /// Of an rgb view: what the scene's exposure is multiplied by. 1: values are radiance; 1/pi: irradiance;
    /// 0: values are colours in [0,1] already and are shown as they are.
    double exposureScale = 1.0;
};

struct ChapterInfo {
    std::string name;             ///< "03_polygon_offset"
    std::string idea;             ///< one line: the new idea
    std::vector<ViewInfo> views;  ///< color and visibility first
    bool needsGl = true;          ///< false: renders on the CPU (chapter 00)
    /// What drawing takes of memory for each pixel, most: frame buffer, depth, the picture as it is read
    /// back, as bytes and encoded, and what the chapter itself keeps for each pixel. Too little: a large
    /// picture ends with the process killed in place of a line that says why.
    int bytesPerPixel = 64;
};

/// Everything one frame needs. Positions are relative to scene.origin.
struct Frame {
    const Scene& scene;
    const GpuScene* gpu;     ///< null for a CPU chapter
    const Context* context;  ///< null for a CPU chapter
    const Camera& camera;
    glm::ivec2 size;  ///< pixels
    std::string view;
    std::uint32_t framebuffer;  ///< RGBA32F (RGBA16F or RGBA8 in the fallback) and depth; bound and with
                                ///< viewport set on entry
    WorkCounters& work;
    std::uint32_t seed;
    const Skips& skips;  ///< `if (frame.skips(keptMaps))`: which work may be left out; the same picture
    /// CPU chapters put their picture here (1 or 3 channels).
    FloatImage* cpuPicture;
    const ProgressCallback& progress;
    /// Times passes by name: `PassScope scope(frame.passTimer, "depth");`. Null unless --pass-times.
    PassTimer* passTimer = nullptr;
    /// Render shadow maps again although nothing changed: set while timing, so that frame_ms is the price of
    /// a frame in which the light moves. --still clears it, and then what was kept from the frame before may
    /// be used.
    bool renderMapsAgain = false;
};

/// What a truth needs besides the frame.
struct TruthRequest {
    const Scene& scene;
    const RayTracer& tracer;
    const Camera& camera;
    glm::ivec2 size;
    std::string view;
    const ProgressCallback& progress;
    const Context* context;  ///< null for a CPU chapter
};

class Chapter {
 public:
    virtual ~Chapter() = default;
    /// Declares the parameters and the skips; called once, before anything else.
    virtual void declare(Parameters& parameters) = 0;
    /// Called once for each scene, with the context current (if any): create GL objects here.
    virtual void load(const Scene& scene, const Context* context) = 0;
    /// Draws frame.view into frame.framebuffer: linear values, rgb (scalar views: r), alpha 1.
    virtual void render(const Frame& frame) = 0;
    /// The exact answer for request.view. Throws UsageError if this view has none.
    virtual TruthImage truth(const TruthRequest& request) = 0;
    /// For a chapter whose `truth` is not the area light itself: the area light's exact answer for the same
    /// view, which is reported beside the other. Nothing for another view or another kind of light.
    virtual std::optional<TruthImage> areaLightTruth(const TruthRequest&) { return std::nullopt; }
    /// Programs to watch for hot reload.
    virtual std::vector<Program*> programs() { return {}; }
};

/// Runs the command line of the design for one chapter; returns the exit status. Never throws.
int runChapter(const ChapterInfo& info, const std::function<std::unique_ptr<Chapter>()>& make, int argc,
               char** argv);

template <class C>
int runChapter(const ChapterInfo& info, int argc, char** argv) {
    return runChapter(
        info, [] { return std::make_unique<C>(); }, argc, argv);
}

}  // namespace penumbra
