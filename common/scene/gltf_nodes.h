// The node tree as a list of placed nodes. Internal to the loader.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "common/scene/gltf_document.h"

namespace penumbra::gltf {

struct PlacedNode {
    int node = 0;
    glm::dmat4 sceneFromNode{1.0};
};

/// Every node reachable from the default scene, parents before children, in file order. `origin` is
/// subtracted from the translation of the root before anything is multiplied with it: a scene under a root
/// that is a million metres away then gets the same matrices as at home, not ones that have been rounded out
/// there. Throws Error for a node reached twice (a cycle, or two parents) or out of range, and for a
/// transform that is not finite.
std::vector<PlacedNode> placeNodes(const Document& document, const glm::dvec3& origin);

/// The name of a node for messages and lists: its own, or "node 7".
std::string nodeName(const Document& document, int node);

}  // namespace penumbra::gltf
