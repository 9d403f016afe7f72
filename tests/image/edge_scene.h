// One straight shadow edge over the whole picture, at any angle to the map's texels.
#pragma once

#include <cmath>

#include "chapters/01_depth_from_light/light_frustum.h"
#include "tests/image/small_scenes.h"

namespace penumbra {

enum class Occluder { halfPlane, quarterPlane, allButAQuarter };

/// A metre of ground under a sun straight above, seen from straight above by a flat camera below the
/// occluder.
class EdgeScene {
 public:
    /// The edge runs at `angle` radians to the map's rows, a `phase` of a texel away from the middle of a map
    /// of `mapSize` texels. The corner of a quarter plane lies there too.
    EdgeScene(double angle, int mapSize, double phase = 0.37, Occluder occluder = Occluder::halfPlane)
        : mapSize_(mapSize) {
        const glm::dvec3 along(std::cos(angle), 0, std::sin(angle)),
            across(-std::sin(angle), 0, std::cos(angle));
        const glm::dvec3 middle = glm::dvec3(0, 2, 0) + (along + across) * (phase / mapSize);
        const double far = 9.0;
        SmallScene made;
        made.quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
        if (occluder == Occluder::halfPlane)
            made.part({{middle - far * along, middle + far * along, middle + far * across}}, false);
        if (occluder == Occluder::quarterPlane) made.quad(middle, far * along, far * across);
        if (occluder == Occluder::allButAQuarter) {
            made.quad(middle, far * along, -far * across);
            made.quad(middle, -far * along, far * across);
            made.quad(middle, -far * along, -far * across);
        }
        scene = made.light(LightType::directional, {0, 0, 0}, {0, -1, 0})
                    .flatCamera({0, 1, 0}, {0, 0, 0}, 1.0)
                    .take();
        textureFromWorld_ = fitLightFrustum(scene, scene.lights[0], scene.cameras[0], 1.0).textureFromWorld();
        onEdge_ = texelsOf(middle);
        const glm::dvec2 onMap = texelsOf(middle + along) - onEdge_;
        normal_ = glm::normalize(glm::dvec2(-onMap.y, onMap.x));
        if (glm::dot(normal_, texelsOf(middle + across) - onEdge_) > 0.0) normal_ = -normal_;
    }

    /// Unit, on the map, towards the lit side.
    glm::dvec2 normal() const { return normal_; }

    /// Where pixel (x, y) of a square picture falls on the map, texels.
    glm::dvec2 texels(int x, int y, int pictureSize) const {
        const Ray ray = cameraRay(scene.cameras[0], {x + 0.5, y + 0.5}, glm::ivec2(pictureSize));
        return texelsOf(ray.origin - ray.direction * (ray.origin.y / ray.direction.y));
    }
    /// Texels to the edge, positive where lit.
    double distance(int x, int y, int pictureSize) const {
        return glm::dot(normal_, texels(x, y, pictureSize) - onEdge_);
    }
    /// The same to the edge of the texels that are dark. The edge must run along their rows.
    double texelisedDistance(int x, int y, int pictureSize) const {
        const int axis = std::abs(normal_.x) > std::abs(normal_.y) ? 0 : 1;
        return normal_[axis] * (texels(x, y, pictureSize)[axis] - std::round(onEdge_[axis]));
    }
    /// Texels to the border of the map.
    double inside(int x, int y, int pictureSize) const {
        const glm::dvec2 p = texels(x, y, pictureSize), q = double(mapSize_) - p;
        return std::min(std::min(p.x, p.y), std::min(q.x, q.y));
    }

    Scene scene;

 private:
    glm::dvec2 texelsOf(const glm::dvec3& p) const {
        return double(mapSize_) * glm::dvec2(textureFromWorld_ * glm::dvec4(p, 1.0));
    }

    int mapSize_;
    glm::dmat4 textureFromWorld_{1.0};
    glm::dvec2 onEdge_{0.0}, normal_{0.0};
};

}  // namespace penumbra
