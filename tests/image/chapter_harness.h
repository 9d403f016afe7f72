// A chapter under test, in this process: its own render() and truth(), without a command line in between.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "chapters/01_depth_from_light/shadow_options.h"
#include "common/app/chapter.h"
#include "common/gl/render_target.h"
#include "common/scene/find_scene.h"
#include "common/scene/gltf_loader.h"

namespace penumbra {

/// The one context of the process, made when first asked for, without a window. Asking for the other api
/// makes a new one: everything made with the first must be gone by then.
inline const Context& testContext(Api api = Api::desktop) {
    // Never destroyed at exit: by then the driver's own statics may be gone, and it would hang.
    static Context* context = nullptr;
    static Api made = api;
    if (!context || made != api) {
        delete context;
        context = nullptr;
        ContextRequest request;
        request.api = api;
        context = createContext(request).release();
        made = api;
    }
    return *context;
}

/// A scene of assets/ by name, or any file. Loaded once.
inline const Scene& testScene(const std::string& nameOrFile) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(nameOrFile);
    if (found != scenes.end()) return found->second;
    return scenes.emplace(nameOrFile, loadGltf(findScene(nameOrFile))).first->second;
}

/// Values that are not the same to the bit; both pictures must have the same size and channels.
inline std::size_t differing(const FloatImage& a, const FloatImage& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) count += a.values[i] != b.values[i];
    return count;
}

/// Parameters by name, and their values.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// One chapter with one scene.
class ChapterHarness {
 public:
    ChapterHarness(std::unique_ptr<Chapter> chapter, const Scene& theScene, Api api = Api::desktop)
        : scene(theScene),
          camera(theScene.cameras.at(0)),
          context_(testContext(api)),
          gpu_(theScene, context_.capabilities()),
          chapter_(std::move(chapter)),
          parameters_(std::make_shared<Parameters>()) {
        chapter_->declare(*parameters_);
        load();
    }
    /// The chapter of `other` as it is, its programs compiled, for another scene: what most of a test's time
    /// would go into is saved. `other` must still be there, so that nothing of this scene has an address that
    /// the chapter knows. A chapter that keeps something of a scene needs load() too.
    ChapterHarness(const ChapterHarness& other, const Scene& theScene)
        : scene(theScene),
          camera(theScene.cameras.at(0)),
          context_(other.context_),
          gpu_(theScene, context_.capabilities()),
          chapter_(other.chapter_),
          parameters_(other.parameters_),
          target_(other.target_) {}

    void load() { chapter_->load(scene, &context_); }

    void set(const std::string& parameter, const std::string& value) { parameters_->set(parameter, value); }
    /// Those that the chapter declared; `harness.skips().switchOff("kept-maps")` is --no-skip kept-maps.
    Skips& skips() { return parameters_->skips(); }
    void set(const Settings& settings) {
        for (const auto& [parameter, value] : settings) set(parameter, value);
    }

    /// A frame like the one a chapter is given, its framebuffer bound.
    Frame frame(const std::string& view, const glm::ivec2& size) {
        if (!target_ || target_->size() != size)
            target_ = std::make_shared<RenderTarget>(size, context_.capabilities());
        target_->bind();
        work.clear();
        skips_ = parameters_->skips();
        declareMapSkips(skips_);  // tests use the frame for maps of their own too
        if (!skip) skips_.switchAllOff();
        return {.scene = scene,
                .gpu = &gpu_,
                .context = contextInstead ? contextInstead : &context_,
                .camera = camera,
                .size = size,
                .view = view,
                .framebuffer = target_->framebuffer(),
                .work = work,
                .seed = seed,
                .skips = skips_,
                .cpuPicture = &cpuPicture_,
                .progress = progress,
                .passTimer = passTimer,
                .renderMapsAgain = renderMapsAgain};
    }

    /// Draws, and waits until it is drawn.
    void render(const std::string& view, const glm::ivec2& size) {
        chapter_->render(frame(view, size));
        glFinish();
    }

    /// The picture, top row first.
    FloatImage picture(const std::string& view, const glm::ivec2& size, int channels) {
        cpuPicture_ = {};
        chapter_->render(frame(view, size));
        if (!cpuPicture_.values.empty()) return cpuPicture_;  // chapter 00's, with its own channels
        checkGlErrors(view.c_str());
        return target_->read(channels);
    }
    FloatImage scalar(const std::string& view, const glm::ivec2& size) { return picture(view, size, 1); }

    const Capabilities& capabilities() const { return context_.capabilities(); }

    /// What was drawn since frame(), by whatever.
    FloatImage readBack(int channels) { return target_->read(channels); }

    TruthImage truth(const std::string& view, const glm::ivec2& size) {
        return chapter_->truth(request(view, size));
    }
    std::optional<TruthImage> areaLightTruth(const std::string& view, const glm::ivec2& size) {
        return chapter_->areaLightTruth(request(view, size));
    }

    const Scene& scene;
    Camera camera;                 ///< the scene's first, to be changed at will
    bool skip = true;              ///< false: --skip-none
    bool renderMapsAgain = false;  ///< as a timed frame does
    ProgressCallback progress;     ///< of the frames; none: they are silent
    std::uint32_t seed = 0;        ///< of every random pattern
    WorkCounters work;             ///< of the latest picture
    PassTimer* passTimer = nullptr;
    const Context* contextInstead = nullptr;  ///< what a frame says it is drawn with: one that can do less

 private:
    TruthRequest request(const std::string& view, const glm::ivec2& size) {
        if (!tracer_) tracer_ = std::make_unique<RayTracer>(scene);
        return {scene, *tracer_, camera, size, view, progress, &context_};
    }

    const Context& context_;
    GpuScene gpu_;
    std::shared_ptr<Chapter> chapter_;
    std::shared_ptr<Parameters> parameters_;
    std::shared_ptr<RenderTarget> target_;
    Skips skips_;  ///< of the latest frame
    std::unique_ptr<RayTracer> tracer_;
    FloatImage cpuPicture_;
};

}  // namespace penumbra
