#include "chapters/09_ambient_occlusion/pixel_rays.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <numbers>

#include "chapters/09_ambient_occlusion/edge_rays.h"
#include "common/math/sampling.h"
#include "common/truth/parallel.h"

namespace penumbra {

namespace {

constexpr int coarsest = 16;  ///< pixels; a power of 4

/// What a point sees, and the radiance that the sky sends to it.
struct Seen {
    AmbientValue value;
    glm::dvec3 radiance{0.0};
    std::int64_t asked = 0;  ///< rays: traced, or known to get away
};

// [begin:pixels]
Seen seenEvenly(const RayTracer& tracer, const Hit& hit, const AmbientRays& rays, std::uint32_t seed,
                const Sky& sky) {
    Seen seen;
    const auto directions = castAmbientRays(tracer, hit, hit.shadingNormal, rays, seed, seen.asked);
    seen.value = averageOf(directions);
    for (const AmbientDirection& d : directions) {
        seen.radiance += d.open * sky.radiance(d.direction);
        seen.asked += rays.nothingAbove && d.open == 1.0;
    }
    seen.radiance /= double(rays.count);
    return seen;
}
// [end:pixels]

}  // namespace

glm::dvec3 sunlight(const RayTracer& tracer, const Light& sun, const Hit& hit, const glm::dvec3& normal) {
    const glm::dvec3 toSun = -sun.direction;
    const double facing = glm::dot(normal, toSun);
    if (facing <= 0.0 || glm::dot(hit.geometricNormal, toSun) <= 0.0) return glm::dvec3(0.0);
    if (tracer.occludedTowards(hit, toSun)) return glm::dvec3(0.0);
    return sun.emission * (facing / std::numbers::pi);
}

void PixelRays::tracePixel(const Frame& frame, const AmbientOptions& options, const SkyLight& light,
                           const glm::ivec2& pixel, Counts& counts) {
    const Ray ray = cameraRay(frame.camera, glm::dvec2(pixel) + 0.5, size_);
    Hit hit = tracer_.nearest(ray);
    if (pixel.y == size_.y / 2) middleRow_[std::size_t(pixel.x)] = hit;
    const std::size_t i = 4 * texel(pixel.x, pixel.y);
    if (!hit.valid) {
        std::fill_n(&valueTexels_[i], 4, 0.0f);
        std::fill_n(&lightTexels_[i], 4, 0.0f);
        return;
    }
    faceTheEye(hit, ray);
    AmbientRays rays = options.rays();
    rays.nothingAbove = frame.skips(raysToOpenSky) && planes_.nothingAbove(hit, rays.reach.range);
    const std::uint32_t seed = hashSeed(pixel.x, pixel.y, frame.seed);
    Seen seen;
    if (options.atEdges) {
        seen.value = estimateAtEdges(tracer_, hit, hit.shadingNormal, rays, seed, seen.asked);
        seen.radiance = seen.value.visibility * light.onOpenGround;
    } else {
        seen = seenEvenly(tracer_, hit, rays, seed, light.sky);
    }
    if (light.sun) seen.radiance += sunlight(tracer_, *light.sun, hit, hit.shadingNormal);
    (rays.nothingAbove ? counts.saved : counts.traced) += seen.asked;
    ++counts.receiving;
    const double A = seen.value.visibility;
    const float work = rays.nothingAbove ? 0.0f : A == 0.0 || A == 1.0 ? 1.0f : 2.0f;
    const glm::vec4 stored(glm::vec3(seen.value.bent), float(A)), lit(glm::vec3(seen.radiance), work);
    std::copy_n(&stored.x, 4, &valueTexels_[i]);
    std::copy_n(&lit.x, 4, &lightTexels_[i]);
}

/// Every step-th pixel of row y, and its block filled with what was found.
void PixelRays::traceRow(const Frame& frame, const AmbientOptions& options, const SkyLight& light, int y,
                         Counts& counts) {
    for (int x = 0; x < size_.x; x += step_) {
        tracePixel(frame, options, light, {x, y}, counts);
        if (step_ == 1) continue;
        const std::size_t from = 4 * texel(x, y);
        for (int v = y; v < std::min(y + step_, size_.y); ++v)
            for (int u = x; u < std::min(x + step_, size_.x); ++u) {
                const std::size_t to = 4 * texel(u, v);
                if (to == from) continue;
                std::copy_n(&valueTexels_[from], 4, &valueTexels_[to]);
                std::copy_n(&lightTexels_[from], 4, &lightTexels_[to]);
            }
    }
}

void PixelRays::traceRows(const Frame& frame, const AmbientOptions& options, int count, bool inParts) {
    const SkyLight& light = options.light(frame.scene);
    const bool middleRow = frame.view == "profile";  // shows no other
    std::mutex mutex;
    parallelRows(
        count,
        [&](int i) {
            const int y = step_ * (row_ + i);
            if (middleRow && y != size_.y / 2) return;
            Counts counts;
            traceRow(frame, options, light, y, counts);
            const std::lock_guard lock(mutex);
            counts_.traced += counts.traced;
            counts_.saved += counts.saved;
            counts_.receiving += counts.receiving;
        },
        inParts ? ProgressCallback() : frame.progress);  // a part is over before anyone asks
    row_ += count;
}

void PixelRays::start(const Frame& frame, const std::string& key, bool inParts) {
    key_ = key;
    size_ = frame.size;
    camera_ = frame.camera;
    const std::size_t pixels = std::size_t(size_.x) * std::size_t(size_.y);
    middleRow_.assign(std::size_t(size_.x), {});
    valueTexels_.assign(4 * pixels, 0.0f);
    lightTexels_.assign(4 * pixels, 0.0f);
    counts_ = {};
    row_ = 0;
    step_ = inParts ? coarsest : 1;
}

/// A whole picture; in a window what a tenth of a second allows, but all blocks of one size at least.
void PixelRays::refine(const Frame& frame, const AmbientOptions& options, bool inParts) {
    const auto stop = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    while (step_ > 0) {
        while (row_ < rows()) {
            if (inParts && step_ < coarsest && std::chrono::steady_clock::now() > stop) return;
            traceRows(frame, options, inParts ? std::min(4, rows() - row_) : rows(), inParts);
        }
        step_ /= 4;
        row_ = 0;
        if (step_ > 0) counts_ = {};
    }
}

void PixelRays::update(const Frame& frame, const AmbientOptions& options, bool inParts) {
    inParts = inParts && frame.view != "profile";  // of which one row is traced anyway
    const std::string key = options.visibilityKey(frame.seed) + options.lightKey() +
                            (frame.skips(raysToOpenSky) ? "" : " all") +
                            (frame.view == "profile" ? " middle row" : "");
    const bool done = step_ == 0;
    if (frame.renderMapsAgain || (done && !frame.skips(keptRays)) || key != key_ || size_ != frame.size ||
        camera_ != frame.camera)
        start(frame, key, inParts);
    const bool traces = step_ > 0;
    if (traces) {
        key_.clear();  // should the sky's file be broken, the next frame tries again
        refine(frame, options, inParts);
        key_ = key;
        upload(size_);
    }
    frame.work["primary_rays"] = std::int64_t(size_.x) * size_.y;
    frame.work["rays_traced"] = traces ? counts_.traced : 0;
    frame.work["rays_saved"] = counts_.saved;
    frame.work["pixels_receiving"] = counts_.receiving;
    if (step_ > 0) frame.work["rows_left"] = rows() - row_;
}

void PixelRays::upload(const glm::ivec2& size) {
    if (!values_ || values_->size() != size) {
        values_.emplace(size, GL_RGBA32F);
        light_.emplace(size, GL_RGBA32F);
    }
    values_->upload(valueTexels_);
    light_->upload(lightTexels_);
}

float PixelRays::visibility(std::size_t pixel) const {
    const int x = int(pixel) % size_.x, y = int(pixel) / size_.x;
    return valueTexels_[4 * texel(x, y) + 3];
}

}  // namespace penumbra
