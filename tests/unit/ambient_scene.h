// A point and what is around it, as a scene of triangles, and exactly what of the sky it then sees.
#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "common/math/hemisphere.h"
#include "common/math/polygon.h"
#include "common/truth/ambient_forms.h"
#include "common/truth/surface_hit.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {

/// Exactly what is seen from `point` past the triangles that turn their front to it, if none of these hides
/// another: the sky less what each of them hides. Columns of `worldFromPoint`: tangent, bitangent, normal.
inline AmbientForm exactForm(const Scene& scene, const glm::dvec3& point, const glm::dmat3& worldFromPoint) {
    const glm::dmat3 pointFromWorld = glm::transpose(worldFromPoint);
    DirectionMoments blocked;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
        Polygon3 triangle;
        for (const glm::dvec3& corner : cornersOf(scene, t)) triangle.push(pointFromWorld * (corner - point));
        // Its back; or the point lies in its plane, but for rounding.
        const double size = glm::length(triangle[0]) * glm::length(triangle[1]) * glm::length(triangle[2]);
        if (glm::dot(triangle[0], glm::cross(triangle[1], triangle[2])) >= -1e-14 * size) continue;
        const Polygon3 above = clip(triangle, [](const glm::dvec3& p) { return p.z; });
        if (above.empty()) continue;
        const DirectionMoments m = polygonMoments(above.span());
        blocked.solidAngle += m.solidAngle;
        blocked.first += m.first;
        blocked.second += m.second;
    }
    return ambientBesides(blocked);
}

/// A scene around one of its points, the centroid of triangle 0. It is described in any frame, and turned and
/// moved from there into the world by what the constructor is given.
class AmbientScene {
 public:
    explicit AmbientScene(const glm::dmat3& turn) : scene_(test_meshes::emptyScene()), turn_(turn) {
        place_ = [turn](const glm::dvec3& p) { return turn * p + glm::dvec3(1, -2, 3); };
    }

    /// A triangle about the origin, normal +z. It hides nothing, so its size does not matter.
    void ground() { mesh({{-0.1, -0.1, 0}, {0.2, -0.1, 0}, {-0.1, 0.2, 0}}, {0, 1, 2}); }
    /// Its front (counter-clockwise) towards the point.
    void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
        mesh({a, b, c, d}, {0, 1, 2, 0, 2, 3});
    }
    /// Any mesh whose front is what the point sees of it.
    void mesh(const std::vector<glm::dvec3>& points, const std::vector<std::uint32_t>& indices) {
        test_meshes::addPart(scene_, points, indices, place_);
    }
    /// Hides exactly the directions between two planes through the y axis, at angles `from` to `to` (at most
    /// pi) from +x towards +z: what anything endless along y hides from this one point. Eight triangles that
    /// meet on the y axis, so that nothing has to be long.
    void wedge(double from, double to) {
        constexpr int parts = 4;
        const auto at = [&](int i) {
            const double angle = from + (to - from) * i / parts;
            return glm::dvec3(std::cos(angle), 0.0, std::sin(angle));
        };
        for (int i = 0; i < parts; ++i) {
            mesh({{0, 1, 0}, at(i), at(i + 1)}, {0, 1, 2});
            mesh({{0, -1, 0}, at(i + 1), at(i)}, {0, 1, 2});
        }
    }
    void sphere(const glm::dvec3& centre, double radius, int levels) {
        test_meshes::addSphere(
            scene_, levels, [&](const glm::dvec3& p) { return place_(centre + radius * glm::normalize(p)); });
    }

    const Scene& scene() const { return scene_; }
    Hit point() const { return surfaceHit(scene_, 0, glm::dvec2(1.0 / 3.0)); }

    /// Of the point: its normal is that of triangle 0, and x what was x before the scene was turned.
    glm::dmat3 worldFromPoint() const {
        const glm::dvec3 n = point().geometricNormal;
        const glm::dvec3 x = glm::normalize(turn_[0] - glm::dot(turn_[0], n) * n);
        return {x, glm::cross(n, x), n};
    }

    AmbientForm exact() const { return exactForm(scene_, point().position, worldFromPoint()); }

 private:
    Scene scene_;
    glm::dmat3 turn_;
    test_meshes::Place place_;
};

/// Turned about z by an even share of a whole turn, so that edges have all orientations to the sample
/// pattern, and then anyhow in space.
inline glm::dmat3 turned(int index, int count, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double angle = 2.0 * std::numbers::pi * (index + uniform(random)) / count;
    const double c = std::cos(angle), s = std::sin(angle);
    return frameAround(test_meshes::randomDirection(random)) *
           glm::dmat3(glm::dvec3(c, s, 0), glm::dvec3(-s, c, 0), glm::dvec3(0, 0, 1));
}

}  // namespace penumbra
