#include "chapters/10_accumulated_occlusion/accumulated_occlusion.h"

#include <algorithm>
#include <optional>

#include "chapters/10_accumulated_occlusion/direction_batches.h"
#include "chapters/10_accumulated_occlusion/receivers.h"
#include "chapters/10_accumulated_occlusion/visibility_sums.h"
#include "common/app/pass_timer.h"

namespace penumbra {

namespace {

constexpr int mostDirections = 16384;  ///< of --rotate: more would change no colour of a screen

/// All that the sums depend on. Scenes are immutable once loaded, so the pointer stands for the surfaces.
struct Key {
    const Scene* scene = nullptr;
    std::optional<Camera> camera;  ///< none: receivers are the vertices
    glm::ivec2 size{0};
    OcclusionOptions options;
    std::uint32_t seed = 0;
    bool countWork = false;
    std::vector<glm::dvec3> radiances;  ///< of the sky, in the directions of the pattern
    std::vector<GLuint> programs;       ///< a shader that was loaded again is another
    bool operator==(const Key&) const = default;
};

std::vector<glm::dvec3> radiancesOf(const Sky& sky, const std::vector<glm::dvec3>& directions) {
    std::vector<glm::dvec3> radiances;
    for (const glm::dvec3& l : directions) radiances.push_back(sky.radiance(l));
    return radiances;
}

}  // namespace

struct AccumulatedOcclusion::State {
    Program depth{"01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag"};
    Receivers receivers;
    VisibilitySums sums;
    std::optional<SkyMaps> maps;
    std::optional<ReceiverHorizons> horizons;
    std::optional<Key> held;
    BoundingSphere sphere;
    SkyBias bound;
    std::uint32_t frames = 0;  ///< that were added up
    bool perVertex = false;

    std::vector<Program*> programs();
    std::vector<GLuint> programIds();
    void begin(const Frame& frame, const OcclusionOptions& options);
    void addDirections(const Frame& frame, const OcclusionOptions& options, const Sky& sky,
                       std::vector<glm::dvec3> directions);
    void addBatch(const Frame& frame, const OcclusionOptions& options, const Sky& sky,
                  std::span<const glm::dvec3> directions);
};

std::vector<Program*> AccumulatedOcclusion::State::programs() {
    std::vector<Program*> all = sums.programs();
    all.push_back(&depth);
    all.push_back(&receivers.program());
    return all;
}

std::vector<GLuint> AccumulatedOcclusion::State::programIds() {
    std::vector<GLuint> ids;
    for (const Program* program : programs()) ids.push_back(program->id());
    return ids;
}

/// New receivers, and nothing added up.
void AccumulatedOcclusion::State::begin(const Frame& frame, const OcclusionOptions& options) {
    perVertex = options.perVertex();
    if (perVertex)
        receivers.uploadVertices(frame.scene);
    else
        receivers.drawPixels(frame);
    horizons.reset();
    if (frame.skips(mapsBelowHorizon)) horizons.emplace(receivers.readNormals());
    sphere = boundingSphere(frame.scene);
    sums.clear(receivers.size());
    frames = 0;
    const DepthFormat format = depthFormat(options.depthFormat, frame.context->capabilities());
    const int layers = SkyMaps::layersFor(options.mapSize, std::min(options.samples, VisibilitySums::batch));
    if (!maps || maps->mapSize() != options.mapSize || maps->format() != format || maps->layers() != layers)
        maps.emplace(options.mapSize, format, layers);
}

// [begin:batches]
void AccumulatedOcclusion::State::addDirections(const Frame& frame, const OcclusionOptions& options,
                                                const Sky& sky, std::vector<glm::dvec3> directions) {
    directions = compactOrder(std::move(directions), VisibilitySums::leaf);
    const std::size_t all = directions.size();
    std::vector<LightFrustum> everyone;
    for (const glm::dvec3& l : directions) everyone.push_back(skyFrustum(sphere, l));
    bound = skyBias(maps->format(), everyone, frame.scene.bounds, options.mapSize);
    // What is below everyone's horizon needs no map.
    if (horizons) std::erase_if(directions, [&](const glm::dvec3& l) { return !horizons->above(l); });
    frame.work["directions_added"] += std::int64_t(all);
    frame.work["shadow_maps_skipped"] += std::int64_t(all - directions.size());
    const std::span<const glm::dvec3> rest(directions);
    const std::size_t batch = std::size_t(maps->layers());
    for (std::size_t first = 0; first < rest.size(); first += batch)
        addBatch(frame, options, sky, rest.subspan(first, std::min(batch, rest.size() - first)));
}

void AccumulatedOcclusion::State::addBatch(const Frame& frame, const OcclusionOptions& options,
                                           const Sky& sky, std::span<const glm::dvec3> directions) {
    std::vector<LightFrustum> frusta;
    std::vector<glm::dvec3> radiances;
    for (const glm::dvec3& l : directions) {
        frusta.push_back(skyFrustum(sphere, l));
        radiances.push_back(sky.radiance(l));
    }
    // Pass 2: the scene from each of these directions.
    maps->render(depth, frame, frusta);
    // Pass 3: every receiver looks all of them up.
    const PassScope scope(frame.passTimer, "look-ups");
    sums.add(receivers, *maps,
             {directions, radiances, frusta, bound, frame.skips(lookUpsFacingAway), frame.view == "work",
              options.bias, options.softEdges() ? cellTangent(options.samples) : 0.0});
}
// [end:batches]

AccumulatedOcclusion::AccumulatedOcclusion() : state_(std::make_unique<State>()) {}
AccumulatedOcclusion::~AccumulatedOcclusion() = default;
AccumulatedOcclusion::AccumulatedOcclusion(AccumulatedOcclusion&&) noexcept = default;
AccumulatedOcclusion& AccumulatedOcclusion::operator=(AccumulatedOcclusion&&) noexcept = default;

AmbientTextures AccumulatedOcclusion::update(const Frame& frame, const OcclusionOptions& options,
                                             const Sky& sky) {
    State& state = *state_;
    std::vector<glm::dvec3> directions = skyDirections(options.samples, options.directions, frame.seed);
    Key wanted{&frame.scene,
               options.perVertex() ? std::nullopt : std::optional(frame.camera),
               options.perVertex() ? glm::ivec2(0) : frame.size,
               options,
               frame.seed,
               frame.view == "work",
               radiancesOf(sky, directions),
               state.programIds()};
    const bool same = state.held && *state.held == wanted;
    if (!same || (!options.rotate && (!frame.skips(keptOcclusion) || frame.renderMapsAgain))) {
        state.begin(frame, options);  // Pass 1: where the receivers are
        state.held = std::move(wanted);
    }
    const auto added = [&] { return int(state.frames) * options.samples; };
    if (state.frames == 0 || (options.rotate && added() < mostDirections)) {
        const glm::dmat3 rotation = skyRotation(state.frames, frame.seed);
        for (glm::dvec3& l : directions) l = rotation * l;
        state.addDirections(frame, options, sky, std::move(directions));
        ++state.frames;
        state.sums.resolve(added());                // Pass 4: the means
        state.held->programs = state.programIds();  // some are compiled when they are first needed
    }
    if (options.rotate) frame.work["directions_left"] = std::max(0, mostDirections - added());
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glViewport(0, 0, frame.size.x, frame.size.y);
    const TexturePair& resolved = state.sums.resolved();
    return {resolved.first(), resolved.second(), resolved.size(), state.perVertex};
}

std::vector<AmbientValue> AccumulatedOcclusion::vertexValues(const Scene& scene) const {
    const std::vector<glm::vec4> texels = state_->sums.resolved().readFirst();
    std::vector<AmbientValue> values;
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
        values.push_back({double(texels[i].w), glm::dvec3(texels[i])});
    return values;
}

std::vector<Program*> AccumulatedOcclusion::programs() {
    return state_->programs();
}

}  // namespace penumbra
