// The depth pass of GpuScene against a bare loop over the same triangles: gl_bench [SCENE] [ROUNDS]
//
// The bare loop has everything in one vertex buffer and one index buffer, positions alone, and issues one
// glDrawElements with back faces culled. GpuScene draws the same triangles with back faces of closed parts
// culled, cluster by cluster.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <vector>

#include "common/error.h"
#include "common/gl/context.h"
#include "common/gl/program.h"
#include "common/scene/camera.h"
#include "common/scene/find_scene.h"
#include "common/scene/gltf_loader.h"
#include "common/scene/gpu_scene.h"
#include "tests/bench/clocks.h"

namespace penumbra {
namespace {

constexpr int mapSize = 1024;

/// Looks at the whole scene from above, like a sun: every triangle is in the map.
glm::dmat4 sunClipFromWorld(const Scene& scene) {
    const double radius = scene.bounds.radius();
    const glm::dvec3 forward = glm::normalize(glm::dvec3(-0.4, -1.0, -0.3));
    const glm::dvec3 eye = scene.bounds.centre() - 2.0 * radius * forward;
    return orthographic(-radius, radius, -radius, radius, radius, 3.0 * radius) * viewFromWorld(eye, forward);
}

struct DepthMap {
    GlTexture texture;
    GlFramebuffer framebuffer;
    DepthMap() {
        glBindTexture(GL_TEXTURE_2D, texture.id());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, mapSize, mapSize, 0, GL_DEPTH_COMPONENT,
                     GL_UNSIGNED_INT, nullptr);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture.id(), 0);
        const GLenum none = GL_NONE;
        glDrawBuffers(1, &none);
        requireCompleteFramebuffer("the depth map");
        glViewport(0, 0, mapSize, mapSize);
        glEnable(GL_DEPTH_TEST);
    }
};

struct BareLoop {
    GlVertexArray array;
    GlBuffer positions, indices;
    GLsizei count;
    explicit BareLoop(const Scene& scene) : count(GLsizei(scene.indices.size())) {
        glBindVertexArray(array.id());
        glBindBuffer(GL_ARRAY_BUFFER, positions.id());
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(scene.positions.size() * sizeof(glm::vec3)),
                     scene.positions.data(), GL_STATIC_DRAW);
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(scene.indices.size() * sizeof(std::uint32_t)),
                     scene.indices.data(), GL_STATIC_DRAW);
    }
    void draw() const {
        glBindVertexArray(array.id());
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
        glDisable(GL_CULL_FACE);
    }
};

double milliseconds(const std::function<void()>& draw) {
    const double start = wallTime();
    glClear(GL_DEPTH_BUFFER_BIT);
    draw();
    glFinish();
    return wallTime() - start;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

void run(const std::string& name, int rounds) {
    const Scene scene = loadGltf(findScene(name));
    const auto context = createContext({});
    const GpuScene gpu(scene, context->capabilities());
    const BareLoop bare(scene);
    const DepthMap map;
    Program program("tests/position.vert", "tests/nothing.frag");
    const glm::dmat4 clipFromWorld = sunClipFromWorld(scene);
    program.set("uClipFromWorld", glm::mat4(clipFromWorld));
    program.prepareToDraw();
    const VisibleClusters visible = visibleClusters(scene, Frustum(clipFromWorld));

    const std::vector<std::pair<const char*, std::function<void()>>> ways = {
        {"one bare glDrawElements, back faces culled", [&] { bare.draw(); }},
        {"GpuScene::drawDepth", [&] { gpu.drawDepth({.visible = &visible}); }},
        {"GpuScene::drawDepth, nothing culled",
         [&] { gpu.drawDepth({.visible = &visible, .cullClosed = false}); }}};
    std::vector<std::vector<double>> times(ways.size());
    for (int round = -2; round < rounds;
         ++round)  // two to warm up; interleaved, so that a slow moment hits all alike
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const double time = milliseconds(ways[i].second);
            if (round >= 0) times[i].push_back(time);
        }
    const auto closedTriangles = std::accumulate(
        scene.parts.begin(), scene.parts.end(), std::size_t(0),
        [](std::size_t sum, const Part& part) { return sum + (part.closed ? part.triangleCount : 0); });
    fmt::print("{}: {} triangles, {:.0f} % in closed parts; {}\n", scene.name, scene.triangleCount(),
               100.0 * double(closedTriangles) / double(scene.triangleCount()), context->renderer());
    for (std::size_t i = 0; i < ways.size(); ++i)
        fmt::print("{:45} {:7.2f} ms {:6.2f} Mtri/s {:5.2f} of bare\n", ways[i].first, median(times[i]),
                   1e-3 * double(scene.triangleCount()) / median(times[i]),
                   median(times[0]) / median(times[i]));
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
    try {
        penumbra::run(argc > 1 ? argv[1] : "courtyard", argc > 2 ? std::atoi(argv[2]) : 25);
        return penumbra::exitFine;
    } catch (const penumbra::Error& error) {
        fmt::print(stderr, "gl_bench: {}\n", error.what());
        return error.status();
    }
}
