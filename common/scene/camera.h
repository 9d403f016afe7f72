// Matrices and rays of a scene camera.
#pragma once

#include <glm/glm.hpp>

#include "common/math/transforms.h"
#include "common/scene/scene.h"

namespace penumbra {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  ///< not normalised: direction has unit length along the camera's axis
};

glm::dmat4 viewFromWorld(const Camera& camera);
/// `aspect` = width / height.
glm::dmat4 clipFromView(const Camera& camera, double aspect, DepthRange range = DepthRange::standard);
glm::dmat4 clipFromWorld(const Camera& camera, double aspect);
/// The ray through `pixel` (x right, y DOWN, in pixels; a pixel's centre is at +0.5) of a `size` picture.
Ray cameraRay(const Camera& camera, const glm::dvec2& pixel, const glm::ivec2& size);

}  // namespace penumbra
