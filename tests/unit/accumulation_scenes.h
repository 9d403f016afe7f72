// Lights, receivers and occluders for the tests of chapter 08, plain and random.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "common/math/polygon.h"
#include "common/math/sampling.h"
#include "common/truth/cone_subtraction.h"
#include "tests/unit/figure_two.h"
#include "tests/unit/test_meshes.h"

namespace penumbra::accumulation_scenes {

using glm::dvec3;
using Corners = std::vector<dvec3>;

/// Counter-clockwise seen from its front.
inline Light areaLight(const Corners& polygon) {
    Light light;
    light.type = LightType::area;
    light.direction = glm::normalize(areaNormal(polygon));
    light.polygons = {polygon};
    light.area = polygonArea(polygon);
    light.position = dvec3(0.0);
    for (const dvec3& p : polygon) light.position += p / double(polygon.size());
    return light;
}

/// The square light of Heckbert & Herf's figure 2, with z up.
inline Light squareLight() {
    return areaLight(figure_two::light);
}

inline const Triangle& figureTriangle = figure_two::triangle;

inline Receiver receiverOn(const dvec3& corner, const dvec3& u, const dvec3& v, const glm::ivec2& texels) {
    Receiver receiver;
    receiver.corner = corner;
    receiver.uEdge = u;
    receiver.vEdge = v;
    receiver.normal = glm::normalize(glm::cross(u, v));
    receiver.area = glm::length(glm::cross(u, v));
    receiver.texels = texels;
    return receiver;
}

/// The receiver of figure 2.
inline Receiver figureReceiver(int texels) {
    return receiverOn({-1.2, -1.2, 0}, {2.4, 0, 0}, {0, 2.4, 0}, {texels, texels});
}

/// The loader's clusters and bounds, one cluster for each part.
inline void addClusters(Scene& scene) {
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        scene.clusters.push_back({part.firstTriangle, part.triangleCount, i, part.bounds});
    }
}

/// A flat part of nothing but these triangles.
inline void addTriangles(Scene& scene, const std::vector<Triangle>& triangles) {
    std::vector<dvec3> points;
    std::vector<std::uint32_t> indices;
    for (const Triangle& t : triangles)
        for (const dvec3& p : t) {
            indices.push_back(std::uint32_t(points.size()));
            points.push_back(p);
        }
    test_meshes::addPart(scene, points, indices, test_meshes::scaledAndMoved(1.0, 0.0));
}

/// No expression here draws twice outside braces: compilers call operands in different orders, and a test
/// that counts would see other scenes with each.
class Random {
 public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double between(double a, double b) { return a + (b - a) * uniform_(engine_); }
    int below(int n) { return int(between(0.0, n)); }
    dvec3 inBox(double half) {
        const double x = between(-half, half), y = between(-half, half);
        return {x, y, between(-half, half)};
    }
    dvec3 direction() {
        for (;;) {
            const dvec3 v = inBox(1.0);
            if (glm::length(v) > 0.1 && glm::length(v) < 1.0) return glm::normalize(v);
        }
    }
    /// A convex polygon of 3 to 6 corners on a circle, facing `normal`.
    Corners polygon(const dvec3& centre, const dvec3& normal, double radius) {
        const dvec3 axis = std::abs(normal.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        const dvec3 u = glm::normalize(glm::cross(axis, normal)), v = glm::cross(normal, u);
        const int count = 3 + below(4);
        Corners corners;
        for (int i = 0; i < count; ++i) {
            const double angle = 6.283185307179586 * (i + between(0.0, 0.8)) / count;
            corners.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
        }
        return corners;
    }
    /// A parallelogram anywhere within a metre or two of the origin, any tilt.
    Receiver receiver(const glm::ivec2& texels) {
        const double length = between(0.2, 2.0), height = between(0.2, 2.0), slant = between(-0.5, 0.5);
        const dvec3 u = length * direction();
        const dvec3 v = height * glm::normalize(glm::cross(u, direction())) + slant * u;
        return receiverOn(inBox(1.0) - 0.5 * (u + v), u, v, texels);
    }
    /// A polygonal light near `receiver`: above it, across its horizon, in its plane, or shining away.
    Light lightNear(const Receiver& receiver) {
        const dvec3 towards = receiver.at({between(-0.5, 1.5), between(-0.5, 1.5)});
        const double height = between(-0.3, 2.5), radius = between(0.05, 1.0);
        const dvec3 centre = towards + height * receiver.normal + 0.3 * inBox(1.0);
        const dvec3 facing =
            below(3) == 0 ? direction() : glm::normalize(towards - centre + 0.3 * inBox(1.0));
        return areaLight(polygon(centre, facing, radius));
    }
    Triangle triangleNear(const Receiver& receiver, const Light& light) {
        const dvec3 end = receiver.at({between(-0.3, 1.3), between(-0.3, 1.3)});
        const double way = between(-0.2, 1.2), size = between(0.01, 1.0);
        const dvec3 centre = glm::mix(end, light.position, way) + 0.5 * inBox(1.0);
        Triangle t = {centre + size * inBox(1.0), centre + size * inBox(1.0), centre + size * inBox(1.0)};
        if (below(20) == 0) t[2] = glm::mix(t[0], t[1], between(0.0, 1.0));   // no area
        if (below(20) == 0) t[0] -= receiver.height(t[0]) * receiver.normal;  // touches the plane
        return t;
    }

 private:
    std::mt19937 engine_;
    std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

}  // namespace penumbra::accumulation_scenes
