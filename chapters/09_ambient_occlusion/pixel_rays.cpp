#include "chapters/09_ambient_occlusion/pixel_rays.h"

#include <algorithm>
#include <mutex>
#include <numbers>

#include "common/math/sampling.h"
#include "common/truth/parallel.h"

namespace penumbra {

glm::dvec3 sunlight(const RayTracer& tracer, const Light& sun, const Hit& hit, const glm::dvec3& normal) {
    const glm::dvec3 toSun = -sun.direction;
    const double facing = glm::dot(normal, toSun);
    if (facing <= 0.0 || glm::dot(hit.geometricNormal, toSun) <= 0.0) return glm::dvec3(0.0);
    if (tracer.occludedTowards(hit, toSun)) return glm::dvec3(0.0);
    return sun.emission * (facing / std::numbers::pi);
}

void PixelRays::findHits(const Frame& frame) {
    if (camera_ && *camera_ == frame.camera && size_ == frame.size) return;
    size_ = frame.size;
    camera_ = frame.camera;
    hits_.assign(std::size_t(size_.x) * std::size_t(size_.y), {});
    parallelRows(size_.y, [&](int y) {
        for (int x = 0; x < size_.x; ++x) {
            const Ray ray = cameraRay(frame.camera, {x + 0.5, y + 0.5}, size_);
            Hit& hit = hits_[std::size_t(y) * size_.x + x];
            hit = tracer_.nearest(ray);
            faceTheEye(hit, ray);
        }
    });
    key_.clear();
}

// [begin:pixels]
void PixelRays::traceRow(const Frame& frame, const AmbientOptions& options, const SkyLight& light, int y,
                         Counts& counts) {
    AmbientRays rays = options.rays();
    for (int x = 0; x < size_.x; ++x) {
        const Hit& hit = hits_[std::size_t(y) * size_.x + x];
        if (!hit.valid) continue;
        rays.nothingAbove = frame.skip && planes_.nothingAbove(hit, rays.reach.range);
        const auto directions =
            castAmbientRays(tracer_, hit, hit.shadingNormal, rays, hashSeed(x, y, frame.seed), counts.traced);
        const AmbientValue value = averageOf(directions);
        glm::dvec3 sum(0.0);
        std::int64_t open = 0;
        for (const AmbientDirection& d : directions) {
            sum += d.open * light.sky.radiance(d.direction);
            open += d.open == 1.0;
        }
        glm::dvec3 radiance = sum / double(rays.count);
        if (light.sun) radiance += sunlight(tracer_, *light.sun, hit, hit.shadingNormal);
        if (rays.nothingAbove) counts.saved += open;
        const float work = rays.nothingAbove ? 0.0f : open == 0 || open == rays.count ? 1.0f : 2.0f;
        ++counts.receiving;
        const std::size_t i = 4 * texel(x, y);
        const glm::vec4 stored(glm::vec3(value.bent), float(value.visibility)),
            lit(glm::vec3(radiance), work);
        std::copy_n(&stored.x, 4, &valueTexels_[i]);
        std::copy_n(&lit.x, 4, &lightTexels_[i]);
    }
}
// [end:pixels]

void PixelRays::update(const Frame& frame, const AmbientOptions& options) {
    const SkyLight& light = options.light(frame.scene);
    findHits(frame);
    const bool middleRow = frame.view == "profile";  // shows no other
    const std::string key = options.visibilityKey(frame.seed) + options.lightKey() +
                            (frame.skip ? "" : " all") + (middleRow ? " middle row" : "");
    if (frame.renderMapsAgain || key != key_) {
        key_ = key;
        counts_ = {};
        valueTexels_.assign(4 * hits_.size(), 0.0f);
        lightTexels_.assign(4 * hits_.size(), 0.0f);
        std::mutex mutex;
        parallelRows(
            size_.y,
            [&](int y) {
                if (middleRow && y != size_.y / 2) return;
                Counts counts;
                traceRow(frame, options, light, y, counts);
                const std::lock_guard lock(mutex);
                counts_.traced += counts.traced;
                counts_.saved += counts.saved;
                counts_.receiving += counts.receiving;
            },
            frame.progress);
        upload(size_);
    }
    frame.work["primary_rays"] = std::int64_t(hits_.size());
    frame.work["rays_traced"] = counts_.traced;
    frame.work["rays_saved"] = counts_.saved;
    frame.work["pixels_receiving"] = counts_.receiving;
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
