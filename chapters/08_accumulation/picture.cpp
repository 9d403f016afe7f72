#include "chapters/08_accumulation/picture.h"

#include <algorithm>

#include "chapters/08_accumulation/lit_sides.h"
#include "common/scene/gpu_light.h"

namespace penumbra {

namespace {

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

Picture::Picture()
    : other_("08_accumulation/picture.vert", "08_accumulation/other.frag"),
      received_("08_accumulation/picture.vert", "08_accumulation/received.frag"),
      dark_(glm::ivec2(1), GL_RGBA32F) {
    dark_.upload({0.0f, 0.0f, 0.0f, 1.0f});
}

void Picture::setView(Program& program, const Frame& frame, const AccumulationOptions& options) {
    program.set("uClipFromWorld",
                glm::mat4(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y)));
    program.set("uAmbientRadiance", ambientRadiance(frame.scene, options.maps.light, ambientShare));
    program.set("uView", viewNumber(frame.view));
}

void Picture::draw(const Frame& frame, const AccumulationOptions& options, const ReceivedLight* received) {
    std::vector<int> lights = options.chosenLights(frame.scene);
    if (frame.view == "visibility" || frame.view == "work") lights.resize(1);  // of the first
    const OtherSurfaces others(frame, received ? received->receivers() : std::vector<Receiver>{});
    clearPicture(frame, options.maps);
    for (std::size_t i = 0; i < lights.size(); ++i) drawOthers(frame, options, others, lights[i], i == 0);
    if (received) drawReceivers(frame, options, *received);
}

void Picture::drawOthers(const Frame& frame, const AccumulationOptions& options, const OtherSurfaces& others,
                         int index, bool first) {
    const Light& whole = frame.scene.lights[std::size_t(index)];
    const Light light = options.lit(frame.scene, index);
    const bool all = options.method == "shadow-maps";
    const bool shadowed = all || (options.others == "shadow-maps" && others.count() > 0);
    const auto drawSeen = [&](Program& program) { others.draw(program, frame); };
    GLuint sums = 0;
    if (shadowed) {
        std::vector<LightPoint> points =
            options.points(whole, all ? options.samples : options.othersSamples, frame.seed);
        std::erase_if(points, [&](const LightPoint& point) {
            return !inLightPart(whole, options.lightPart, point.position);
        });
        sums = maps_.run(frame, options.maps, light, points, drawSeen).texture();
    } else {
        frame.work["others_unshadowed"] = others.count();
    }
    other_.setTexture("uMapSums", GL_TEXTURE_2D, sums);
    setView(other_, frame, options);
    setLight(other_, light);
    setTriangles(light);
    other_.set("uShadowed", shadowed);
    other_.set("uFirstLight", first);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(first ? GL_LESS : GL_EQUAL);
    if (!first) glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    drawSeen(other_);
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
    other_.setTexture("uLightTriangles", GL_TEXTURE_2D, triangles_->id());
    other_.set("uTriangleCount", count);
    other_.set("uRadiance", glm::vec3(light.emission));
}

void Picture::drawReceiver(const Frame& frame, const Receiver& receiver) {
    received_.set("uTexelX", texelRow(receiver, 0));
    received_.set("uTexelY", texelRow(receiver, 1));
    const DrawCounts drawn = frame.gpu->drawShaded(received_, receiver.part, rangesOf(receiver.triangles));
    frame.work["triangles_shaded"] += std::int64_t(drawn.triangles);
    frame.work["draw_calls"] += std::int64_t(drawn.drawCalls);
}

// [begin:receivers]
void Picture::drawReceivers(const Frame& frame, const AccumulationOptions& options,
                            const ReceivedLight& received) {
    setView(received_, frame, options);
    glEnable(GL_DEPTH_TEST);
    // A side that is no receiver gets no light. It is drawn first, and both sides have the same depths.
    glDepthFunc(GL_LEQUAL);
    received_.setTexture("uReceived", GL_TEXTURE_2D, dark_.id());
    for (const Receiver& receiver : received.receivers()) drawReceiver(frame, receiver);
    drawLitSides(
        received.receivers(), [&](std::size_t i) { return received.texture(i) != nullptr; },
        [&](std::size_t i) {
            received_.setTexture("uReceived", GL_TEXTURE_2D, received.texture(i)->texture());
            drawReceiver(frame, received.receivers()[i]);
        });
}
// [end:receivers]

std::vector<Program*> Picture::programs() {
    std::vector<Program*> all = maps_.programs();
    all.insert(all.end(), {&other_, &received_});
    return all;
}

}  // namespace penumbra
