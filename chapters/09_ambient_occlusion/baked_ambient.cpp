#include "chapters/09_ambient_occlusion/baked_ambient.h"

#include <fmt/format.h>

#include <numbers>
#include <numeric>

#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/09_ambient_occlusion/bake_file.h"
#include "common/app/pass_timer.h"
#include "common/error.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

namespace {

constexpr int floatsPerVertex = 8;  // bent vector, visibility; radiance, work

/// Where a bake that is interrupted waits to be taken up again: one of values, and one of bits, for each
/// scene.
std::filesystem::path partialFile(const Scene& scene, std::string_view what) {
    return truthCacheFolder() / fmt::format("{}-{}.bake", ContentHash().geometry(scene).hex(), what);
}

}  // namespace

Scene withoutSharedVertices(const Scene& scene) {
    Scene result = scene;
    const auto spread = [&](auto& values) {
        const auto shared = values;
        values.clear();
        values.reserve(scene.indices.size());
        for (const std::uint32_t index : scene.indices) values.push_back(shared[index]);
    };
    spread(result.positions);
    spread(result.normals);
    spread(result.uvs);
    std::iota(result.indices.begin(), result.indices.end(), 0u);
    return result;
}

void BakedAmbient::update(const Frame& frame, const AmbientOptions& options) {
    const std::string visibilityKey =
        options.visibilityKey(frame.seed) + (frame.skips(raysToOpenSky) ? "" : "!");
    const std::string lightKey = options.lightKey();
    const bool stale = visibilityKey != visibilityKey_;
    if (stale) {
        visibilityKey_.clear();  // should the bake fail, the next frame tries again
        bake(frame, options);
        visibilityKey_ = visibilityKey;
    }
    if (stale || frame.renderMapsAgain || lightKey != lightKey_) {
        const PassScope scope(frame.passTimer, "light");
        lightKey_.clear();
        relightAll(options);
        upload(frame.context->capabilities());
        lightKey_ = lightKey;
    }
    frame.work["points"] = work_.points;
    frame.work["points_merged"] = work_.merged;
    frame.work["points_skipped"] = work_.skipped;
    frame.work["rays_baked"] = work_.rays;
    frame.work["rays_traced"] = stale ? work_.rays : 0;
    frame.work["bytes_stored"] = std::int64_t(bits_ ? bits_->bytes() : values_.size() * 4 * sizeof(float));
}

void BakedAmbient::bake(const Frame& frame, const AmbientOptions& options) {
    const PassScope scope(frame.passTimer, "bake");
    bits_.reset();
    work_ = {};
    perTriangle_ = options.method == "triangles";
    if (options.method == "stored") {
        const auto loaded = loadedAmbient(scene_);
        if (!loaded)
            throw UsageError(
                fmt::format("--method stored: {} holds no baked values; make them with --method "
                            "vertices --save FILE.glb and open that file with --scene",
                            scene_.name));
        values_ = *loaded;
        return;
    }
    if (options.save != "none") requireSavable(options.save);
    if (!bundle_) bundle_.emplace(scene_);
    if (options.method == "bits") {
        bakeBitsOf(frame, options);
    } else {
        const BakeSettings settings{options.rays(), frame.seed, options.share, frame.skips(raysToOpenSky),
                                    partialFile(scene_, "values")};
        AmbientBake baked = perTriangle_ ? bakeTriangles(scene_, *bundle_, settings, frame.progress)
                            : options.values == "least-squares"
                                ? bakeVerticesLeastSquares(scene_, *bundle_, settings, 4, frame.progress)
                                : bakeVertices(scene_, *bundle_, settings, frame.progress);
        values_ = std::move(baked.values);
        work_ = baked.work;
    }
    if (options.save != "none") saveAmbient(scene_, values_, options.save);
}

// [begin:bits]
void BakedAmbient::bakeBitsOf(const Frame& frame, const AmbientOptions& options) {
    if (options.samples < 64 || options.samples > 1024)
        throw UsageError(
            fmt::format("--samples {}: --method bits stores 64 to 1024 directions", options.samples));
    const AmbientRays rays = options.rays();
    BakedBits baked =
        penumbra::bakeBits(scene_, *bundle_, options.samples, rays.reach, partialFile(scene_, "bits"),
                           frame.progress, frame.skips(raysToOpenSky));
    bits_ = std::move(baked.bits);
    work_ = baked.work;
    values_.resize(bits_->points);
    for (std::size_t i = 0; i < values_.size(); ++i)
        values_[i] = ambientFromBits(*bits_, i, glm::dvec3(scene_.normals[i]), rays.weighting);
}
// [end:bits]

// [begin:relight]
void BakedAmbient::relightAll(const AmbientOptions& options) {
    const SkyLight& light = options.light(scene_);
    light_.resize(values_.size());
    if (!bits_) {  // a number: the sky is as bright everywhere as it is on average
        for (std::size_t i = 0; i < values_.size(); ++i)
            light_[i] = glm::vec3(values_[i].visibility * light.onOpenGround);
        return;
    }
    std::vector<glm::vec3> radiance = skyRadiance(light.sky, bits_->directions);
    if (light.sun) addSun(bits_->directions, -light.sun->direction, light.sun->emission, radiance);
    light_ = relight(*bits_, scene_.normals, radiance);
    for (glm::vec3& irradiance : light_) irradiance /= float(std::numbers::pi);
}
// [end:relight]

void BakedAmbient::upload(const Capabilities& capabilities) {
    std::vector<float> floats;
    const std::size_t vertices = perTriangle_ ? 3 * values_.size() : values_.size();
    floats.reserve(vertices * floatsPerVertex);
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
        const std::size_t i = perTriangle_ ? vertex / 3 : vertex;
        const glm::vec3 bent(values_[i].bent);
        floats.insert(floats.end(), {bent.x, bent.y, bent.z, float(values_[i].visibility), light_[i].x,
                                     light_[i].y, light_[i].z, 1.0f});
    }
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, attributes_.id());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(floats.size() * sizeof(float)), floats.data(), GL_STATIC_DRAW);
    if (!perTriangle_ || unshared_) return;
    unshared_ = std::make_unique<Scene>(withoutSharedVertices(scene_));
    gpuUnshared_ = std::make_unique<GpuScene>(*unshared_, capabilities);
}

// [begin:attributes]
void BakedAmbient::draw(Program& program, const Frame& frame) const {
    const GpuScene& gpu = perTriangle_ ? *gpuUnshared_ : *frame.gpu;
    glBindVertexArray(gpu.shadedArray());
    glBindBuffer(GL_ARRAY_BUFFER, attributes_.id());
    for (GLuint i = 0; i < 2; ++i) {
        glEnableVertexAttribArray(3 + i);
        glVertexAttribPointer(3 + i, 4, GL_FLOAT, GL_FALSE, floatsPerVertex * sizeof(float),
                              reinterpret_cast<const void*>(i * 4 * sizeof(float)));
    }
    drawPicture(program, frame, gpu);
    glBindVertexArray(gpu.shadedArray());
    for (GLuint i = 0; i < 2; ++i) glDisableVertexAttribArray(3 + i);
}
// [end:attributes]

}  // namespace penumbra
