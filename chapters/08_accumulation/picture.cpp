#include "chapters/08_accumulation/picture.h"

#include <algorithm>

#include "common/scene/gpu_light.h"

namespace penumbra {

namespace {

/// Neighbouring triangles in one range. `triangles` ascending.
std::vector<IndexRange> rangesOf(const std::vector<std::uint32_t>& triangles) {
    std::vector<IndexRange> ranges;
    for (const std::uint32_t triangle : triangles) {
        if (!ranges.empty() && ranges.back().firstTriangle + ranges.back().triangleCount == triangle)
            ++ranges.back().triangleCount;
        else
            ranges.push_back({triangle, 1});
    }
    return ranges;
}

/// dot(., (p, 1)) is the texel coordinate of p along u (`axis` 0) or v.
glm::vec4 texelRow(const Receiver& receiver, int axis) {
    const glm::dvec2 zero = receiver.uv(glm::dvec3(0.0));
    glm::dvec4 row;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 unit(0.0);
        unit[i] = 1.0;
        row[i] = receiver.uv(unit)[axis] - zero[axis];
    }
    row.w = zero[axis];
    return row * double(receiver.texels[axis]);
}

int viewNumber(const std::string& view) {
    return view == "visibility" ? 1 : view == "irradiance" ? 2 : view == "work" ? 3 : 0;
}

}  // namespace

Picture::Picture(const Scene&)
    : other_("08_accumulation/picture.vert", "08_accumulation/other.frag"),
      received_("08_accumulation/picture.vert", "08_accumulation/received.frag") {}

void Picture::setView(Program& program, const Frame& frame, const AccumulationOptions& options) {
    program.set("uClipFromWorld",
                glm::mat4(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y)));
    program.set("uAmbientRadiance", ambientRadiance(frame.scene, options.light, ambientShare));
    program.set("uView", viewNumber(frame.view));
}

// [begin:picture]
void Picture::draw(const Frame& frame, const AccumulationOptions& options, const ReceivedLight* received) {
    std::vector<int> lights = options.chosenLights(frame.scene);
    if (frame.view == "visibility" || frame.view == "work") lights.resize(1);  // of the first
    const std::int64_t others = received ? otherTriangles(frame.scene, received->receivers()) : 1;
    const bool shadowed = !received || (options.others == "shadow-maps" && others > 0);
    if (!shadowed) frame.work["others_unshadowed"] = others;
    clearPicture(frame, options.maps);
    for (std::size_t i = 0; i < lights.size(); ++i) drawOthers(frame, options, lights[i], i == 0, shadowed);
    if (received) drawReceivers(frame, options, *received);
}
// [end:picture]

void Picture::drawOthers(const Frame& frame, const AccumulationOptions& options, int index, bool first,
                         bool shadowed) {
    const Light& whole = frame.scene.lights[std::size_t(index)];
    const Light light = options.lit(frame.scene, index);
    if (shadowed) {
        const int count = options.method == "shadow-maps" ? options.samples : options.othersSamples;
        std::vector<LightPoint> points = options.points(whole, count, frame.seed);
        std::erase_if(points, [&](const LightPoint& point) {
            return !inLightPart(whole, options.lightPart, point.position);
        });
        other_.setTexture("uMapSums", GL_TEXTURE_2D, maps_.run(frame, options.maps, light, points).texture());
    } else {
        other_.setTexture("uMapSums", GL_TEXTURE_2D, 0);
    }
    setView(other_, frame, options);
    setLight(other_, light);
    setTriangles(light);
    other_.set("uShadowed", shadowed);
    other_.set("uFirstLight", first);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(first ? GL_LESS : GL_EQUAL);
    if (!first) glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    drawPicture(other_, frame);
    glBlendFunc(GL_ONE, GL_ZERO);
    glDisable(GL_BLEND);
    glDepthFunc(GL_LESS);
}

void Picture::setTriangles(const Light& light) {
    std::vector<float> corners;
    for (const auto& polygon : light.polygons)
        for (std::size_t i = 2; i < polygon.size(); ++i)
            for (const std::size_t k : {std::size_t(0), i - 1, i})
                for (const double value : {polygon[k].x, polygon[k].y, polygon[k].z, 1.0})
                    corners.push_back(float(value));
    const int count = int(corners.size() / 12);
    if (!triangles_ || triangles_->size().y != std::max(1, count))
        triangles_.emplace(glm::ivec2(3, std::max(1, count)), GL_RGBA32F);
    corners.resize(std::size_t(12) * std::size_t(std::max(1, count)));
    triangles_->upload(corners);
    other_.setTexture("uLightTriangles", GL_TEXTURE_2D, triangles_->texture());
    other_.set("uTriangleCount", count);
    other_.set("uRadiance", glm::vec3(light.emission));
}

// [begin:receivers]
void Picture::drawReceivers(const Frame& frame, const AccumulationOptions& options,
                            const ReceivedLight& received) {
    setView(received_, frame, options);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);  // over what was drawn in closed form, at the same depths
    glEnable(GL_CULL_FACE);  // each side of a surface is a receiver of its own
    for (std::size_t i = 0; i < received.receivers().size(); ++i) {
        const Receiver& receiver = received.receivers()[i];
        if (!received.texture(i)) continue;
        received_.setTexture("uReceived", GL_TEXTURE_2D, received.texture(i)->texture());
        received_.set("uTexelX", texelRow(receiver, 0));
        received_.set("uTexelY", texelRow(receiver, 1));
        glCullFace(receiver.back ? GL_FRONT : GL_BACK);
        const DrawCounts drawn =
            frame.gpu->drawShaded(received_, receiver.part, rangesOf(receiver.triangles));
        frame.work["draw_calls"] += std::int64_t(drawn.drawCalls);
    }
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LESS);
}
// [end:receivers]

std::vector<Program*> Picture::programs() {
    std::vector<Program*> all = maps_.programs();
    all.insert(all.end(), {&other_, &received_});
    return all;
}

std::int64_t otherTriangles(const Scene& scene, const std::vector<Receiver>& receivers) {
    std::vector<bool> received(scene.triangleCount(), false);
    for (const Receiver& receiver : receivers)
        for (const std::uint32_t triangle : receiver.triangles) received[triangle] = true;
    for (const Light& light : scene.lights) {
        if (light.part < 0) continue;
        const Part& part = scene.parts[std::size_t(light.part)];
        std::fill_n(received.begin() + part.firstTriangle, part.triangleCount, true);
    }
    return std::count(received.begin(), received.end(), false);
}

}  // namespace penumbra
