#include "common/app/chapter_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/gl/gl.h"
#include "common/image/tone_map.h"
#include "common/scene/find_scene.h"
#include "common/scene/gltf_loader.h"
#include "common/scene/light.h"
#include "common/text/spelling.h"

namespace penumbra {
namespace {

/// Value of the int parameter "light", or -1 (all lights) if the chapter has none.
int chosenLight(const Parameters& parameters) {
    for (const Parameter& parameter : parameters.all())
        if (const auto* value = std::get_if<int*>(&parameter.value); value && parameter.name == "light")
            return **value;
    return -1;
}

/// What only the loaded scene can tell about a command line.
void requireInScene(const char* flag, int index, std::size_t count, const Scene& scene, const char* what) {
    if (index < int(count)) return;
    throw UsageError(fmt::format("--{} {}: {} has {} {}{}, numbered from 0", flag, index, scene.name, count,
                                 what, count == 1 ? "" : "s"));
}

}  // namespace

ContextRequest contextRequest(const ChapterInfo& info, const Options& options, bool headless) {
    ContextRequest request;
    request.backend = options.backend;
    request.api = options.api;
    request.headless = headless;
    request.windowSize = options.windowSize;
    request.title = "Penumbra " + info.name;
    return request;
}

ChapterSession::ChapterSession(const ChapterInfo& info, std::unique_ptr<Chapter> chapter,
                               Parameters& parameters, const Options& options, bool headless,
                               ProgressCallback progress)
    : info_(info), parameters_(parameters), options_(options), progress_(std::move(progress)) {
    scene_ = loadGltf(findScene(options.scene));
    requireInScene("camera", options.camera, scene_.cameras.size(), scene_, "camera");
    requireInScene("light", chosenLight(parameters), scene_.lights.size(), scene_, "light");
    if (info.needsGl) {
        context_ = createContext(contextRequest(info, options, headless));
        gpu_ = std::make_unique<GpuScene>(scene_, context_->capabilities());
    }
    chapter_ = std::move(chapter);
    chapter_->load(scene_, context_.get());
    if (context_) checkGlErrors("while the chapter was loading");
}

ChapterSession::~ChapterSession() = default;

void ChapterSession::render(const FrameRequest& request) {
    work_.clear();
    if (context_) {
        glBindFramebuffer(GL_FRAMEBUFFER, request.framebuffer);
        glViewport(0, 0, request.size.x, request.size.y);
    }
    const Frame frame{.scene = scene_,
                      .gpu = gpu_.get(),
                      .context = context_.get(),
                      .camera = request.camera,
                      .size = request.size,
                      .view = request.view,
                      .framebuffer = request.framebuffer,
                      .work = work_,
                      .seed = options_.seed,
                      .skips = parameters_.skips(),
                      .cpuPicture = &cpuPicture_,
                      .progress = progress_,
                      .passTimer = request.passTimer,
                      .renderMapsAgain = request.renderMapsAgain};
    chapter_->render(frame);
    if (context_) checkGlErrors(info_.name.c_str());
}

void ChapterSession::renderOffScreen(FrameRequest request) {
    if (context_) {
        if (!target_ || target_->size() != request.size) target_ = makeTarget(request.size);
        request.framebuffer = target_->framebuffer();
    }
    render(request);
}

std::unique_ptr<RenderTarget> ChapterSession::makeTarget(const glm::ivec2& size) {
    target_.reset();  // two large pictures need not fit at once
    try {
        auto target = std::make_unique<RenderTarget>(size, context_->capabilities());
        checkGlErrors("render target");
        return target;
    } catch (const Error& error) {
        throw Error(fmt::format("{}x{} pixels are too many for {}; use a smaller --size or --antialias ({})",
                                size.x, size.y, context_->renderer(), error.what()));
    }
}

FloatImage ChapterSession::readBack(const std::string& name) const {
    const int channels = view(name).scalar ? 1 : 3;
    if (context_) return target_->read(channels);
    if (cpuPicture_.channels != channels)
        throw Error(fmt::format("{}: view {} should have {} channels and has {}", info_.name, name, channels,
                                cpuPicture_.channels));
    return cpuPicture_;
}

FloatImage ChapterSession::picture(const FrameRequest& request) {
    renderOffScreen(request);
    return readBack(request.view);
}

const ViewInfo& ChapterSession::view(const std::string& name) const {
    std::vector<std::string> names;
    for (const ViewInfo& candidate : info_.views) {
        if (candidate.name == name) return candidate;
        names.push_back(candidate.name);
    }
    throw UsageError(
        fmt::format("--view {}: must be one of {}{}", name, joinNames(names), didYouMean(name, names)));
}

float ChapterSession::exposureOf(const ViewInfo& view) const {
    const double stops = std::exp2(options_.exposureEv.value_or(0.0));
    return float(exposure(scene_, chosenLight(parameters_)) * stops * view.exposureScale);
}

std::pair<float, float> ChapterSession::colourRange(const FloatImage& picture) {
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const float v : picture.values) {
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
    }
    return low <= high ? std::pair{low, high} : std::pair{0.0f, 1.0f};
}

FloatImage ChapterSession::display(const FloatImage& picture, const ViewInfo& view) const {
    if (view.scalar && view.falseColour) {
        const auto [low, high] = colourRange(picture);
        return falseColour(picture, low, high);
    }
    if (view.scalar) return toneMap(picture, 1.0f);
    if (view.exposureScale > 0.0) return toneMap(picture, exposureOf(view));
    FloatImage shown = picture;
    for (float& v : shown.values) v = std::clamp(v, 0.0f, 1.0f);
    return shown;
}

}  // namespace penumbra
