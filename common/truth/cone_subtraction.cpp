#include "common/truth/cone_subtraction.h"

#include <cmath>
#include <limits>
#include <vector>

#include "common/truth/lambert_polygon.h"

namespace penumbra {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The infinite cone from x over a triangle: three planes through x, normals inward.
using Cone = std::array<glm::dvec3, 3>;

/// A visible piece of the light that still has to be cut by the cones from `nextCone` on.
struct Piece {
    Polygon3 polygon;
    std::size_t nextCone = 0;
};

/// Reused from call to call, so that the hot loop allocates nothing once it is warm.
struct Workspace {
    std::vector<Cone> cones;
    std::vector<Piece> pieces;
};

Workspace& workspace() {
    thread_local Workspace w;
    return w;
}

double sumOfMagnitudes(const glm::dvec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// a x b up to a factor of 2, with two properties the plain product lacks: exactly negated when a and b swap,
/// so neighbouring triangles share their cone planes to the bit; and accurate for short far edges, since b -
/// a is formed first.
glm::dvec3 edgePlane(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::cross(a + b, b - a);
}

bool outsideSomePlane(const LightPyramid& pyramid, const Triangle& t) {
    for (const glm::dvec3& inward : pyramid.inward.span())
        if (glm::dot(inward, t[0]) <= 0.0 && glm::dot(inward, t[1]) <= 0.0 && glm::dot(inward, t[2]) <= 0.0)
            return true;
    return false;
}

/// Appends the cone over a triangle relative to x, unless it has no solid angle: degenerate, or x lies in its
/// plane as far as doubles can tell (a surface never shadows itself).
void appendCone(const LightPyramid& pyramid, const Triangle& t, std::vector<Cone>& cones) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double volume = glm::dot(t[0], normal);
    const double rounding = pyramid.rounding + 8.0 * epsilon * sumOfMagnitudes(t[0]);
    if (std::abs(volume) <= rounding * glm::length(normal)) return;
    const double sign = volume > 0.0 ? 1.0 : -1.0;
    cones.push_back(
        {sign * edgePlane(t[0], t[1]), sign * edgePlane(t[1], t[2]), sign * edgePlane(t[2], t[0])});
}

/// Appends the cones over what `triangle` (relative to x) has between x and the light's plane: what is behind
/// the light, or is the light's own surface, shadows nothing.
void appendCones(const LightPyramid& pyramid, const Triangle& triangle, std::vector<Cone>& cones) {
    if (outsideSomePlane(pyramid, triangle)) return;
    double front[3];
    for (int i = 0; i < 3; ++i) front[i] = pyramid.inFrontOfLight(triangle[std::size_t(i)]);
    if (std::max({front[0], front[1], front[2]}) <= pyramid.rounding) return;
    if (std::min({front[0], front[1], front[2]}) >= 0.0) return appendCone(pyramid, triangle, cones);
    const Polygon3 part =
        clip(Polygon3(triangle), [&](const glm::dvec3& p) { return pyramid.inFrontOfLight(p); });
    for (int i = 1; i + 1 < part.count; ++i) appendCone(pyramid, {part[0], part[i], part[i + 1]}, cones);
}

bool outsideSomePlane(const Cone& cone, const Polygon3& polygon) {
    for (const glm::dvec3& inward : cone) {
        bool allOutside = true;
        for (int i = 0; i < polygon.count && allOutside; ++i)
            allOutside = glm::dot(inward, polygon[i]) <= 0.0;
        if (allOutside) return true;
    }
    return false;
}

bool covers(const Cone& cone, const Polygon3& polygon) {
    for (const glm::dvec3& inward : cone)
        for (const glm::dvec3& p : polygon.span())
            if (glm::dot(inward, p) < 0.0) return false;
    return true;
}

/// A piece that has grown many corners is halved along a diagonal, so that it always has room to be cut.
void halve(Polygon3& polygon, std::size_t nextCone, std::vector<Piece>& pieces) {
    Polygon3 second;
    for (int i = polygon.count / 2; i < polygon.count; ++i) second.push(polygon[i]);
    second.push(polygon[0]);
    polygon.count = polygon.count / 2 + 1;
    pieces.push_back({second, nextCone});
}

/// Form factor of the part of `piece` outside its next cones; parts that meet further cones are put on the
/// stack.
double subtract(const LightPyramid& pyramid, Piece piece, Workspace& work) {
    Polygon3 inside, outside;
    for (std::size_t i = piece.nextCone; i < work.cones.size(); ++i) {
        const Cone& cone = work.cones[i];
        if (outsideSomePlane(cone, piece.polygon)) continue;
        double sum = 0.0;
        for (const glm::dvec3& inward : cone) {
            if (piece.polygon.count > Polygon3::capacity / 2) halve(piece.polygon, i, work.pieces);
            split(
                piece.polygon, [&](const glm::dvec3& p) { return glm::dot(inward, p); }, inside, outside);
            if (i + 1 == work.cones.size())
                sum += lambertFormFactor(pyramid.normal, outside);
            else if (!outside.empty())
                work.pieces.push_back({outside, i + 1});
            if (inside.empty()) break;
            piece.polygon = inside;
        }
        return sum;
    }
    return lambertFormFactor(pyramid.normal, piece.polygon);
}

}  // namespace

LightPyramid lightPyramid(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon) {
    LightPyramid pyramid;
    pyramid.x = x;
    pyramid.normal = n;
    const glm::dvec3 areaVector = areaNormal(polygon);
    const double length = glm::length(areaVector);
    if (!(length > 0.0)) return pyramid;
    Polygon3 light;
    for (const glm::dvec3& p : polygon) light.push(p - x);
    pyramid.lightNormal = areaVector / length;
    pyramid.height = -glm::dot(pyramid.lightNormal, light[0]);
    // Rounding of the input: x and the scene's points carry half a unit in the last place each, a computed x
    // a little more.
    pyramid.rounding = 8.0 * epsilon * (sumOfMagnitudes(x) + sumOfMagnitudes(light[0]));
    if (pyramid.height <= pyramid.rounding) return pyramid;  // behind the light, or in its plane
    pyramid.light = clip(light, [&](const glm::dvec3& p) { return glm::dot(n, p); });
    for (int i = 0; i < pyramid.light.count; ++i)
        pyramid.inward.push(-edgePlane(pyramid.light[i], pyramid.light[pyramid.light.next(i)]));
    pyramid.inward.push(n);
    return pyramid;
}

bool outside(const LightPyramid& pyramid, const Aabb& box) {
    const glm::dvec3 centre = box.centre() - pyramid.x;
    const glm::dvec3 half = 0.5 * box.size();
    const double slack =
        1.0 + 16.0 * epsilon;  // outward, so that rounding never culls what the exact test would keep
    const double slackLength = 16.0 * epsilon * (sumOfMagnitudes(centre) + sumOfMagnitudes(pyramid.x));
    const auto nearest = [&](const glm::dvec3& normal) {
        const glm::dvec3 size = glm::abs(normal);
        return glm::dot(normal, centre) + slack * glm::dot(size, half) + slackLength * sumOfMagnitudes(size);
    };
    for (const glm::dvec3& inward : pyramid.inward.span())
        if (nearest(inward) < 0.0) return true;
    return nearest(pyramid.lightNormal) + pyramid.height < 0.0;
}

double unoccludedFormFactor(const LightPyramid& pyramid) {
    return lambertFormFactor(pyramid.normal, pyramid.light);
}

double visibleFormFactor(const LightPyramid& pyramid, std::span<const Triangle> occluders) {
    Workspace& work = workspace();
    work.cones.clear();
    work.pieces.clear();
    for (const Triangle& t : occluders) {
        const std::size_t before = work.cones.size();
        appendCones(pyramid, {t[0] - pyramid.x, t[1] - pyramid.x, t[2] - pyramid.x}, work.cones);
        for (std::size_t i = before; i < work.cones.size(); ++i)
            if (covers(work.cones[i], pyramid.light)) return 0.0;
    }
    const double whole = unoccludedFormFactor(pyramid);
    if (work.cones.empty()) return whole;
    double sum = subtract(pyramid, {pyramid.light, 0}, work);
    while (!work.pieces.empty()) {
        const Piece piece = work.pieces.back();
        work.pieces.pop_back();
        sum += subtract(pyramid, piece, work);
    }
    return std::min(
        sum, whole);  // an occluder that hides next to nothing: the rounding of the pieces must not add light
}

}  // namespace penumbra
