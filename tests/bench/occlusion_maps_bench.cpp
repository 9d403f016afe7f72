// What N shadow maps cost and how wrong they are: occlusion_maps_bench [SCENE] [DIRECTIONS] [ROUNDS]. Two
// tables:
//   pixels: 512 x 512 of them, the whole against its bare parts, each alone: as many depth passes of the
//     same mesh into one map, back faces culled, and as many look-ups at each pixel; and the depth passes in
//     two other ways: a draw for each layer of an array, as chapter 10 does, and one instanced draw for each
//     atlas of 16;
//   vertices: by N directions of the whole sphere, of which N/2 are above each vertex, against 1024 rays.
// Rounds are interleaved, times are of the CPU, of all threads together (in brackets: of the clock), and the
// smallest of all rounds. `taskset -c 1` is for a machine that has other things to do; on one core the whole
// is nearer to its parts than on two.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "chapters/01_depth_from_light/shadow_map.h"
#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/10_accumulated_occlusion/accumulated_occlusion.h"
#include "chapters/10_accumulated_occlusion/receivers.h"
#include "chapters/10_accumulated_occlusion/visibility_sums.h"
#include "common/error.h"
#include "tests/bench/clocks.h"
#include "tests/image/chapter_harness.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 pictureSize(512, 512);

/// Nothing but the skips that the frames are asked for: the harness makes its frames.
class NoChapter : public Chapter {
    void declare(Parameters& parameters) override { declareOcclusionSkips(parameters); }
    void load(const Scene&, const Context*) override {}
    void render(const Frame&) override {}
    TruthImage truth(const TruthRequest&) override { return {}; }
};

struct Way {
    std::string name;
    std::function<void()> run;
    double best = 1e30, wall = 1e30;
};

void measure(std::vector<Way>& ways, int rounds) {
    for (int round = -1; round < rounds; ++round)
        for (Way& way : ways) {
            const double wall = wallTime(), cpu = cpuTime();
            way.run();
            glFinish();
            if (round < 0) continue;  // warm-up
            way.best = std::min(way.best, cpuTime() - cpu);
            way.wall = std::min(way.wall, wallTime() - wall);
        }
}

/// The bare parts.
class Parts {
 public:
    Parts(const Scene& scene, int directions, int mapSize, const Frame& frame)
        : all_(skyDirections(directions, "fibonacci", 0)),
          mapSize_(mapSize),
          one_(mapSize, DepthFormat::float32, 1),
          maps_(mapSize, DepthFormat::float32, SkyMaps::layersFor(mapSize, VisibilitySums::batch)),
          lookUp_("common/fullscreen.vert", "tests/bare_look_up.frag",
                  {"BATCH " + std::to_string(maps_.layers())}),
          atlas_(atlasSide * mapSize, DepthFormat::float32),
          sums_(pictureSize) {
        const BoundingSphere sphere = boundingSphere(scene);
        for (const glm::dvec3& l : all_) frusta_.push_back(skyFrustum(sphere, l));
        receivers_.drawPixels(frame);
        maps_.render(depth_, frame, std::span(frusta_).first(std::size_t(maps_.layers())));
    }

    void depthPasses(const Frame& frame) {
        for (const LightFrustum& frustum : frusta_) one_.render(depth_, frame, {&frustum, 1});
    }

    void layers(const Frame& frame) {
        const std::size_t batch = std::size_t(maps_.layers());
        for (std::size_t first = 0; first < frusta_.size(); first += batch)
            maps_.render(depth_, frame,
                         std::span(frusta_).subspan(first, std::min(batch, frusta_.size() - first)));
    }

    /// What lies in one tile's bounds stays there: every frustum is around the whole scene, so that nothing
    /// has to be clipped.
    void atlases(const Frame& frame) {
        const VisibleClusters all = allClusters(frame.scene);
        glBindFramebuffer(GL_FRAMEBUFFER, atlas_.framebuffer());
        glViewport(0, 0, atlas_.size(), atlas_.size());
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LESS);
        for (std::size_t first = 0; first < frusta_.size(); first += tiles) {
            std::vector<glm::vec4> columns;
            for (std::size_t i = first; i < std::min(first + tiles, frusta_.size()); ++i) {
                const std::size_t tile = i - first;
                glm::dmat4 atlasFromClip(1.0);
                atlasFromClip[0][0] = atlasFromClip[1][1] = 1.0 / atlasSide;
                atlasFromClip[3][0] = (2.0 * double(tile % atlasSide) + 1.0) / atlasSide - 1.0;
                atlasFromClip[3][1] = (2.0 * double(tile / atlasSide) + 1.0) / atlasSide - 1.0;
                const glm::mat4 atlasFromWorld(atlasFromClip * frusta_[i].clipFromWorld());
                for (int c = 0; c < 4; ++c) columns.push_back(atlasFromWorld[c]);
            }
            const float farthest = 1.0f;
            glClearBufferfv(GL_DEPTH, 0, &farthest);
            atlasDepth_.set("uAtlasColumns", columns);
            atlasDepth_.prepareToDraw();
            frame.gpu->drawDepth({.visible = &all, .instances = int(columns.size() / 4)});
        }
    }

    void lookUps() {
        const auto row = [](const glm::dmat4& m, int i) {
            return glm::vec4(glm::dvec4(m[0][i], m[1][i], m[2][i], m[3][i]));
        };
        const std::size_t batch = std::size_t(maps_.layers());
        for (std::size_t first = 0; first < all_.size(); first += batch) {
            std::vector<glm::vec4> s, t, r;
            for (std::size_t i = first; i < std::min(first + batch, all_.size()); ++i) {
                const glm::dmat4 m = frusta_[i].textureFromWorld();
                s.push_back(row(m, 0) * float(mapSize_));
                t.push_back(row(m, 1) * float(mapSize_));
                r.push_back(row(m, 2));
            }
            lookUp_.set("uAcross", s);
            lookUp_.set("uUp", t);
            lookUp_.set("uDepth", r);
            lookUp_.set("uCount", int(s.size()));
            lookUp_.setTexture("uPositions", GL_TEXTURE_2D, receivers_.positions());
            lookUp_.setTexture("uMaps", GL_TEXTURE_2D_ARRAY, maps_.texture());
            lookUp_.prepareToDraw();
            sums_.bind();
            glDisable(GL_DEPTH_TEST);
            triangle_.draw();
        }
    }

 private:
    static constexpr int atlasSide = 4;
    static constexpr std::size_t tiles = std::size_t(atlasSide) * atlasSide;

    std::vector<glm::dvec3> all_;
    int mapSize_;
    std::vector<LightFrustum> frusta_;
    SkyMaps one_, maps_;
    Program depth_{"01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag"}, lookUp_;
    Program atlasDepth_{"tests/depth_atlas.vert", "01_depth_from_light/depth.frag", {"TILES 16"}};
    ShadowMap atlas_;
    Receivers receivers_;
    TexturePair sums_;
    FullscreenTriangle triangle_;
};

void pixels(const Scene& scene, int directions, int rounds) {
    for (const int mapSize : {512, 1024}) {
        ChapterHarness harness(std::make_unique<NoChapter>(), scene);
        Frame frame = harness.frame("ambient", pictureSize);
        frame.renderMapsAgain = true;
        Parts parts(scene, directions, mapSize, frame);
        AccumulatedOcclusion whole;
        OcclusionOptions options;
        options.samples = directions;
        options.mapSize = mapSize;
        const Sky sky = Sky::uniform(glm::dvec3(1.0));
        std::vector<Way> ways{{"depth passes", [&] { parts.depthPasses(frame); }},
                              {"look-ups", [&] { parts.lookUps(); }},
                              {"the whole", [&] { whole.update(frame, options, sky); }},
                              {"depth passes into layers", [&] { parts.layers(frame); }},
                              {"into atlases of 16, instanced", [&] { parts.atlases(frame); }}};
        measure(ways, rounds);
        const double sum = ways[0].best + ways[1].best;
        fmt::print("{} pixels {}x{}, {} directions, maps of {}:", scene.name, pictureSize.x, pictureSize.y,
                   directions, mapSize);
        for (const Way& way : ways)
            fmt::print(" {} {:.0f} ms of CPU ({:.0f} ms),", way.name, way.best, way.wall);
        fmt::print(" {:.2f} of the sum of its parts ({:.2f})\n", ways[2].best / sum,
                   ways[2].wall / (ways[0].wall + ways[1].wall));
    }
}

void vertices(const Scene& scene, int rounds) {
    const RayBundle bundle(scene);
    BakeSettings rays;
    rays.rays.count = 1024;
    const std::vector<AmbientValue> exact = bakeVertices(scene, bundle, rays).values;
    struct Case {
        int samples, mapSize;
        const char* edges;
    };
    for (const auto& [samples, mapSize, edges] : {Case{128, 512, "hard"},
                                                  {256, 512, "hard"},
                                                  {64, 512, "soft"},
                                                  {128, 256, "soft"},
                                                  {128, 512, "soft"},
                                                  {128, 1024, "soft"},
                                                  {256, 512, "soft"}}) {
        ChapterHarness harness(std::make_unique<NoChapter>(), scene);
        Frame frame = harness.frame("ambient", {64, 64});
        frame.renderMapsAgain = true;
        AccumulatedOcclusion whole;
        OcclusionOptions options;
        options.method = "vertices";
        options.samples = samples;
        options.mapSize = mapSize;
        options.edges = edges;
        const Sky sky = Sky::uniform(glm::dvec3(1.0));
        std::vector<AmbientValue> values;
        std::vector<Way> ways{{"bake", [&] {
                                   whole.update(frame, options, sky);
                                   values = whole.vertexValues(scene);
                               }}};
        measure(ways, rounds);
        double squares = 0.0, sum = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double error = values[i].visibility - exact[i].visibility;
            squares += error * error;
            sum += error;
        }
        const double count = double(values.size());
        fmt::print(
            "{} {} vertices, {} directions, maps of {:4}, {} edges: {:.0f} ms of CPU ({:.0f} ms), "
            "RMSE {:.4f}, mean error {:+.4f}\n",
            scene.name, values.size(), samples, mapSize, edges, ways[0].best, ways[0].wall,
            std::sqrt(squares / count), sum / count);
    }
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
    try {
        const penumbra::Scene& scene = penumbra::testScene(argc > 1 ? argv[1] : "knot");
        const int directions = argc > 2 ? std::atoi(argv[2]) : 512,
                  rounds = argc > 3 ? std::atoi(argv[3]) : 3;
        penumbra::vertices(scene, rounds);
        penumbra::pixels(scene, directions, rounds);
        return penumbra::exitFine;
    } catch (const penumbra::Error& error) {
        fmt::print(stderr, "occlusion_maps_bench: {}\n", error.what());
        return error.status();
    }
}
