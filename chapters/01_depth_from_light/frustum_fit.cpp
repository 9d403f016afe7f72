#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/01_depth_from_light/light_frustum.h"
#include "common/math/polygon.h"
#include "common/scene/culling.h"

namespace penumbra {

namespace {

/// Half-space n.p + d >= 0 as (n, d).
using Plane = glm::dvec4;
using Points = std::vector<glm::dvec3>;

double side(const Plane& plane, const glm::dvec3& p) {
    return glm::dot(glm::dvec3(plane), p) + plane.w;
}

bool inside(const Aabb& box, const std::vector<Plane>& planes) {
    for (const Plane& plane : planes)
        for (int i = 0; i < 8; ++i)
            if (side(plane, box.corner(i)) < 0) return false;
    return true;
}

bool outside(const Aabb& box, const std::vector<Plane>& planes) {
    return std::any_of(planes.begin(), planes.end(), [&box](const Plane& plane) {
        for (int i = 0; i < 8; ++i)
            if (side(plane, box.corner(i)) >= 0) return false;
        return true;
    });
}

/// Corners of the cluster's triangles after clipping. A cluster wholly inside gives the corners of its box
/// instead: a little too much, and no triangle is touched.
void appendClipped(const Scene& scene, const Cluster& cluster, const std::vector<Plane>& planes,
                   bool boxIfInside, Points& out) {
    if (outside(cluster.bounds, planes)) return;
    if (boxIfInside && inside(cluster.bounds, planes)) {
        for (int i = 0; i < 8; ++i) out.push_back(cluster.bounds.corner(i));
        return;
    }
    for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
        Polygon3 polygon;
        for (int corner = 0; corner < 3; ++corner)
            polygon.push(glm::dvec3(scene.positions[scene.indices[3 * std::size_t(t) + corner]]));
        for (const Plane& plane : planes)
            polygon = clip(polygon, [&plane](const glm::dvec3& p) { return side(plane, p); });
        for (const glm::dvec3& p : polygon.span()) out.push_back(p);
    }
}

/// The four sides of the frustum.
std::vector<Plane> sidePlanes(const LightFrustum& frustum) {
    const glm::dmat4 rows = glm::transpose(frustum.lightViewFromWorld);
    const Plane right = rows[0], up = rows[1], spread = frustum.orthographic ? Plane(0, 0, 0, 1) : -rows[2];
    return {frustum.halfExtent.x * spread + right, frustum.halfExtent.x * spread - right,
            frustum.halfExtent.y * spread + up, frustum.halfExtent.y * spread - up};
}

/// The part of the scene that the light can reach, inside `planes`: the surfaces that can be lit at all.
Points receivers(const Scene& scene, const Light& light, std::vector<Plane> planes) {
    if (light.type == LightType::spot || light.type == LightType::area)
        planes.emplace_back(light.direction, -glm::dot(light.direction, light.position));
    if (light.type == LightType::spot) {
        LightFrustum cone;
        cone.lightViewFromWorld = viewFromWorld(light.position, light.direction);
        cone.halfExtent = glm::dvec2(std::tan(std::min(light.outerCone, widestHalfAngle)));
        for (const Plane& plane : sidePlanes(cone)) planes.push_back(plane);
    }
    Points points;
    for (const Cluster& cluster : scene.clusters)
        if (int(cluster.part) != light.part) appendClipped(scene, cluster, planes, true, points);
    // A light that reaches nothing, or a camera that sees nothing, still gets a map: of the whole scene.
    if (points.empty())
        for (int i = 0; i < 8; ++i) points.push_back(scene.bounds.corner(i));
    return points;
}

/// Axis of the smallest cone from `eye` around the points, by the core-set iteration of Badoiu & Clarkson
/// (2003): move a shrinking step towards the farthest.
glm::dvec3 coneAxis(const glm::dvec3& eye, const Points& points) {
    glm::dvec3 axis(0.0);
    for (const glm::dvec3& p : points)
        if (p != eye) axis += glm::normalize(p - eye);
    if (!(glm::length(axis) > 0)) return {0, -1, 0};
    axis = glm::normalize(axis);
    for (int i = 1; i <= 64; ++i) {
        glm::dvec3 farthest = axis;
        for (const glm::dvec3& p : points)
            if (p != eye && glm::dot(glm::normalize(p - eye), axis) < glm::dot(farthest, axis))
                farthest = glm::normalize(p - eye);
        const glm::dvec3 moved = axis + (farthest - axis) / (i + 1.0);
        if (glm::length(moved) > 0) axis = glm::normalize(moved);
    }
    return axis;
}

/// Distance of the first caster that touches the frustum; a box that cannot improve on the best so far is
/// skipped.
double nearestCaster(const Scene& scene, const Light& light, const LightFrustum& frustum) {
    std::vector<Plane> planes = sidePlanes(frustum);
    // A caster behind the last receiver throws its shadow on nothing.
    planes.push_back(glm::transpose(frustum.lightViewFromWorld)[2] + Plane(0, 0, 0, frustum.far));
    double nearest = frustum.far;
    Points clipped;
    for (const Cluster& cluster : scene.clusters) {
        if (int(cluster.part) == light.part) continue;
        double boxNear = frustum.far;
        for (int i = 0; i < 8; ++i)
            boxNear = std::min(boxNear, frustum.axisDistance(cluster.bounds.corner(i)));
        if (!(boxNear < nearest)) continue;
        clipped.clear();
        appendClipped(scene, cluster, planes, false, clipped);
        for (const glm::dvec3& p : clipped) nearest = std::min(nearest, frustum.axisDistance(p));
    }
    return nearest;
}

void fitBox(LightFrustum& frustum, const Points& points) {
    Aabb box;
    for (const glm::dvec3& p : points)
        box.extend(glm::dvec3(frustum.lightViewFromWorld * glm::dvec4(p, 1.0)));
    const glm::dvec3 centre = box.centre();
    frustum.eye +=
        glm::transpose(glm::dmat3(frustum.lightViewFromWorld)) * glm::dvec3(centre.x, centre.y, 0.0);
    frustum.halfExtent = 0.5 * glm::dvec2(box.size());
    frustum.far = -box.lower.z;
}

void fitPyramid(LightFrustum& frustum, const Points& points, double widestTangent) {
    frustum.halfExtent = glm::dvec2(0.0);
    frustum.far = 0.0;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 v(frustum.lightViewFromWorld * glm::dvec4(p, 1.0));
        const glm::dvec2 tangents = -v.z > 0.0 ? glm::abs(glm::dvec2(v)) / -v.z : glm::dvec2(widestTangent);
        frustum.halfExtent = glm::max(frustum.halfExtent, tangents);
        frustum.far = std::max(frustum.far, -v.z);
    }
    frustum.halfExtent = glm::min(frustum.halfExtent, glm::dvec2(widestTangent));
}

// [begin:fit]
LightFrustum fit(const Scene& scene, const Light& light, const Points& points, DepthRange range) {
    // So that a receiver exactly on a side is still inside after rounding to float.
    constexpr double margin = 1e-3;

    LightFrustum frustum;
    frustum.range = range;
    frustum.orthographic = light.type == LightType::directional;
    frustum.eye = frustum.orthographic ? scene.bounds.centre() : light.position;
    const bool aimed = light.type == LightType::point || light.type == LightType::area;
    const glm::dvec3 axis = aimed ? coneAxis(frustum.eye, points) : light.direction;
    frustum.lightViewFromWorld = viewFromWorld(frustum.eye, axis);

    if (frustum.orthographic) {
        fitBox(frustum, points);
        frustum.lightViewFromWorld = viewFromWorld(frustum.eye, axis);
    } else {
        fitPyramid(frustum, points, std::tan(widestHalfAngle));
    }
    frustum.halfExtent = glm::max(frustum.halfExtent * (1.0 + margin), glm::dvec2(1e-6));
    frustum.near = nearestCaster(scene, light, frustum);

    const double slack = margin * (frustum.orthographic ? frustum.far - frustum.near : frustum.far);
    frustum.far += std::max(slack, 1e-6);
    if (frustum.orthographic) {
        frustum.near -= std::max(slack, 1e-6);
    } else {
        frustum.near *= 1.0 - margin;
        frustum.cutsCasters = frustum.near < smallestNearOverFar * frustum.far;
        frustum.near = std::max(frustum.near, smallestNearOverFar * frustum.far);
    }
    return frustum;
}
// [end:fit]

}  // namespace

LightFrustum fitLightFrustum(const Scene& scene, const Light& light, DepthRange range) {
    return fit(scene, light, receivers(scene, light, {}), range);
}

LightFrustum fitLightFrustum(const Scene& scene, const Light& light, const Camera& camera, double aspect,
                             DepthRange range) {
    const Frustum seen(clipFromWorld(camera, aspect));
    return fit(scene, light, receivers(scene, light, {seen.planes.begin(), seen.planes.end()}), range);
}

}  // namespace penumbra
