#include "common/scene/gltf_views.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra::gltf {
namespace {

constexpr double halfPi = 1.57079632679489661923;

struct Pose {
    glm::dvec3 position, forward, up;
};

/// Cameras and lights look along -Z of their node; its scale is of no effect.
Pose poseOf(const Document& document, const PlacedNode& placed) {
    const glm::dmat4& m = placed.sceneFromNode;
    const glm::dvec3 back(m[2]), right = glm::cross(glm::dvec3(m[1]), back);
    if (!(glm::length(back) > 0.0) || !(glm::length(right) > 0.0)) {
        document.fail(fmt::format("{}: a camera or light needs a node whose scale is not 0",
                                  nodeName(document, placed.node)));
    }
    const glm::dvec3 forward = -glm::normalize(back);
    return {glm::dvec3(m[3]), forward, glm::normalize(glm::cross(-forward, glm::normalize(right)))};
}

Camera perspectiveCamera(const Document& document, const tinygltf::PerspectiveCamera& source,
                         const std::string& who) {
    Camera camera;
    camera.verticalFov = source.yfov;
    camera.near = source.znear;
    camera.far = source.zfar > 0.0 ? source.zfar : std::numeric_limits<double>::infinity();
    if (!(source.yfov > 1e-4 && source.yfov < 2.0 * halfPi - 1e-4)) {
        document.fail(fmt::format("{}: yfov is {}, and must be between 0 and pi", who, source.yfov));
    }
    if (!(camera.near > 0.0 && camera.near < camera.far)) {
        document.fail(fmt::format("{}: 0 < znear < zfar is needed, and they are {} and {}", who, source.znear,
                                  source.zfar));
    }
    return camera;
}

Camera orthographicCamera(const Document& document, const tinygltf::OrthographicCamera& source,
                          const std::string& who) {
    Camera camera;
    camera.orthographic = true;
    camera.height = 2.0 * std::abs(source.ymag);
    camera.near = source.znear;
    camera.far = source.zfar;
    if (!(camera.height > 0.0) || !std::isfinite(camera.height)) {
        document.fail(fmt::format("{}: ymag is {}, and must not be 0", who, source.ymag));
    }
    if (!(camera.near >= 0.0 && camera.near < camera.far)) {
        document.fail(fmt::format("{}: 0 <= znear < zfar is needed, and they are {} and {}", who, camera.near,
                                  camera.far));
    }
    return camera;
}

/// The index of the node's KHR_lights_punctual light, -1: none.
int lightOf(const tinygltf::Node& node) {
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end() || !extension->second.Has("light")) return -1;
    const tinygltf::Value& light = extension->second.Get("light");
    return light.IsNumber() ? light.GetNumberAsInt() : -1;
}

void setCone(Document& document, const tinygltf::SpotLight& spot, Light& light) {
    light.outerCone = std::clamp(spot.outerConeAngle, 1e-4, halfPi);
    // Equal cones would divide by zero in every spot formula: a hair apart is a hard edge.
    light.innerCone = std::clamp(spot.innerConeAngle, 0.0, light.outerCone - 1e-5);
    if (light.outerCone != spot.outerConeAngle || light.innerCone != spot.innerConeAngle) {
        document.note(
            fmt::format("{}: cone angles brought into 0 <= inner < outer <= 90 degrees", light.name));
    }
}

Light convertLight(Document& document, const tinygltf::Light& source, const std::string& name) {
    Light light;
    light.name = name;
    glm::dvec3 colour(1.0);
    if (source.color.size() >= 3) colour = {source.color[0], source.color[1], source.color[2]};
    light.emission = glm::max(colour * source.intensity, 0.0);
    if (source.type == "point") {
        light.type = LightType::point;
    } else if (source.type == "spot") {
        light.type = LightType::spot;
        setCone(document, source.spot, light);
    } else if (source.type == "directional") {
        light.type = LightType::directional;
    } else {
        document.fail(fmt::format("{}: light type {:?} is none of point, spot, directional", name,
                                  printable(source.type, 40)));
    }
    if (source.range > 0.0)
        document.note("the range of lights is ignored: light falls off with the square of distance");
    return light;
}

}  // namespace

void addCameras(const Document& document, const std::vector<PlacedNode>& nodes, Scene& scene) {
    const auto& cameras = document.model->cameras;
    for (const PlacedNode& placed : nodes) {
        const int index = document.model->nodes[std::size_t(placed.node)].camera;
        if (index == -1) continue;
        const std::string who = nodeName(document, placed.node);
        if (index < 0 || std::size_t(index) >= cameras.size()) {
            document.fail(
                fmt::format("{} refers to camera {}, and there are {}", who, index, cameras.size()));
        }
        const tinygltf::Camera& source = cameras[std::size_t(index)];
        Camera camera = source.type == "orthographic" ? orthographicCamera(document, source.orthographic, who)
                                                      : perspectiveCamera(document, source.perspective, who);
        const Pose pose = poseOf(document, placed);
        camera.name = source.name.empty() ? who : printable(source.name, 80);
        camera.position = pose.position;
        camera.forward = pose.forward;
        camera.up = pose.up;
        scene.cameras.push_back(camera);
    }
}

void finishCameras(Scene& scene) {
    for (Camera& camera : scene.cameras) {
        if (std::isfinite(camera.far)) continue;
        double farthest = 0.0;
        for (int i = 0; i < 8; ++i) {
            farthest = std::max(farthest, glm::dot(scene.bounds.corner(i) - camera.position, camera.forward));
        }
        camera.far = std::max(1.01 * farthest, 2.0 * camera.near);
    }
}

void addPunctualLights(Document& document, const std::vector<PlacedNode>& nodes, Scene& scene) {
    const auto& lights = document.model->lights;
    for (const PlacedNode& placed : nodes) {
        const int index = lightOf(document.model->nodes[std::size_t(placed.node)]);
        if (index == -1) continue;
        const std::string who = nodeName(document, placed.node);
        if (index < 0 || std::size_t(index) >= lights.size()) {
            document.fail(fmt::format("{} refers to light {}, and there are {}", who, index, lights.size()));
        }
        const tinygltf::Light& source = lights[std::size_t(index)];
        Light light = convertLight(document, source, source.name.empty() ? who : printable(source.name, 80));
        const Pose pose = poseOf(document, placed);
        light.position = pose.position;
        light.direction = pose.forward;
        if (light.emission == glm::dvec3(0.0)) {
            document.note(fmt::format("light {} is black and is left out", light.name));
            continue;
        }
        scene.lights.push_back(light);
    }
}

}  // namespace penumbra::gltf
