#include "common/scene/gltf_nodes.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace penumbra::gltf {
namespace {

void requireSize(const Document& document, const std::vector<double>& values, std::size_t size, int node,
                 const char* what) {
    if (!values.empty() && values.size() != size) {
        document.fail(
            fmt::format("node {}: {} has {} numbers, and must have {}", node, what, values.size(), size));
    }
}

bool isFinite(const glm::dmat4& m) {
    const double* values = glm::value_ptr(m);
    return std::all_of(values, values + 16, [](double v) { return std::isfinite(v); });
}

glm::dmat4 parentFromNode(const Document& document, int index) {
    const tinygltf::Node& node = document.model->nodes[std::size_t(index)];
    requireSize(document, node.matrix, 16, index, "matrix");
    requireSize(document, node.translation, 3, index, "translation");
    requireSize(document, node.rotation, 4, index, "rotation");
    requireSize(document, node.scale, 3, index, "scale");
    if (!node.matrix.empty()) return glm::make_mat4(node.matrix.data());
    glm::dmat4 m(1.0);
    if (!node.translation.empty()) m = glm::translate(m, glm::make_vec3(node.translation.data()));
    if (!node.rotation.empty()) {
        const std::vector<double>& r = node.rotation;
        const glm::dquat q(r[3], r[0], r[1], r[2]);  // glTF: x y z w; GLM: w first
        const double length = glm::length(q);
        if (!(length > 1e-6)) document.fail(fmt::format("node {}: its rotation is no quaternion", index));
        m *= glm::mat4_cast(q / length);
    }
    if (!node.scale.empty()) m = glm::scale(m, glm::make_vec3(node.scale.data()));
    return m;
}

/// The roots of the default scene; in a file without scenes, the nodes that are nobody's child.
std::vector<int> rootsOf(const Document& document) {
    const tinygltf::Model& model = *document.model;
    if (model.scenes.empty()) {
        std::vector<bool> isChild(model.nodes.size(), false);
        for (const tinygltf::Node& node : model.nodes) {
            for (const int child : node.children) {
                if (child >= 0 && std::size_t(child) < isChild.size()) isChild[std::size_t(child)] = true;
            }
        }
        std::vector<int> roots;
        for (std::size_t i = 0; i < isChild.size(); ++i) {
            if (!isChild[i]) roots.push_back(int(i));
        }
        return roots;
    }
    const int scene = std::max(model.defaultScene, 0);
    if (std::size_t(scene) >= model.scenes.size()) {
        document.fail(fmt::format("the default scene is {}, and there are {}", scene, model.scenes.size()));
    }
    return model.scenes[std::size_t(scene)].nodes;
}

}  // namespace

std::vector<PlacedNode> placeNodes(const Document& document, const glm::dvec3& origin) {
    const std::size_t nodeCount = document.model->nodes.size();
    std::vector<bool> reached(nodeCount, false);
    std::vector<PlacedNode> placed;
    // A stack of our own: a file may nest its nodes deeper than the machine's stack.
    std::vector<PlacedNode> stack;
    const auto pushReversed = [&](const std::vector<int>& nodes, const glm::dmat4& sceneFromParent) {
        for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) stack.push_back({*it, sceneFromParent});
    };
    pushReversed(rootsOf(document), glm::translate(glm::dmat4(1.0), -origin));
    while (!stack.empty()) {
        PlacedNode node = stack.back();
        stack.pop_back();
        if (node.node < 0 || std::size_t(node.node) >= nodeCount) {
            document.fail(
                fmt::format("a scene or node refers to node {}, and there are {}", node.node, nodeCount));
        }
        if (reached[std::size_t(node.node)]) {
            document.fail(
                fmt::format("node {} is reached twice: the nodes form a cycle or share a child, and glTF "
                            "wants a tree; export the scene again",
                            node.node));
        }
        reached[std::size_t(node.node)] = true;
        node.sceneFromNode = node.sceneFromNode * parentFromNode(document, node.node);
        if (!isFinite(node.sceneFromNode)) {
            document.fail(fmt::format("node {}: its transform is not finite", node.node));
        }
        placed.push_back(node);
        pushReversed(document.model->nodes[std::size_t(node.node)].children, node.sceneFromNode);
    }
    return placed;
}

std::string nodeName(const Document& document, int node) {
    const std::string& name = document.model->nodes[std::size_t(node)].name;
    return name.empty() ? fmt::format("node {}", node) : printable(name, 80);
}

}  // namespace penumbra::gltf
