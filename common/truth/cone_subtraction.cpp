#include "common/truth/cone_subtraction.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "common/truth/lambert_polygon.h"

namespace penumbra {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// What a triangle hides, relative to x: the points in the infinite cone from x over it (three planes through
/// x, normals inward) and beyond its own plane. Asking the light's points for that, instead of cutting the
/// triangle off at the light's plane, needs no extra corners, and keeps its digits when x is nearly in the
/// light's plane.
struct Cone {
    std::array<glm::dvec3, 3> inward;
    glm::dvec3 beyond;  ///< the triangle's normal on the side away from x
    Triangle triangle;

    /// >= 0 on the inner side of plane `i`; the planes of the cone are 0, 1, 2, the triangle's own is 3.
    double side(int i, const glm::dvec3& p) const {
        return i < 3 ? glm::dot(inward[std::size_t(i)], p) : glm::dot(beyond, p - triangle[0]);
    }
};

/// A visible piece of the light that still has to be cut by the listed cones from `next` on.
struct Piece {
    Polygon3 polygon;
    std::size_t next = 0;
};

/// Reused from call to call, so that the hot loop allocates nothing once it is warm.
struct Workspace {
    std::vector<Cone> cones;
    std::vector<std::uint32_t> listed;  ///< indices of cones; every part of the light has its list
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

/// No corner of `t` (relative to x) reaches inside one of the pyramid's planes, or in front of the light.
bool misses(const LightPyramid& pyramid, const Triangle& t) {
    const auto front = [&](const glm::dvec3& p) { return glm::dot(pyramid.lightNormal, p) + pyramid.height; };
    if (std::max({front(t[0]), front(t[1]), front(t[2])}) <= pyramid.rounding) return true;
    for (const glm::dvec3& inward : pyramid.inward.span())
        if (glm::dot(inward, t[0]) <= 0.0 && glm::dot(inward, t[1]) <= 0.0 && glm::dot(inward, t[2]) <= 0.0)
            return true;
    return false;
}

bool isOutside(const Cone& cone, const Polygon3& polygon, int plane, double tolerance) {
    for (int i = 0; i < polygon.count; ++i)
        if (cone.side(plane, polygon[i]) > tolerance) return false;
    return true;
}

/// Outside one of the planes: the cone hides nothing of the polygon.
bool misses(const Cone& cone, const Polygon3& polygon) {
    for (int plane = 0; plane < 4; ++plane)
        if (isOutside(cone, polygon, plane, 0.0)) return true;
    return false;
}

bool covers(const Cone& cone, const Polygon3& polygon) {
    for (int plane = 0; plane < 4; ++plane)
        for (const glm::dvec3& p : polygon.span())
            if (cone.side(plane, p) < 0.0) return false;
    return true;
}

/// Appends the cone over triangle `t` (relative to x), unless it can hide nothing of the light: beside the
/// pyramid; degenerate; behind the light or part of its surface; or with x in its plane as far as doubles can
/// tell (no surface shadows itself). So only triangles that do hide something have a say in the order in
/// which pieces are summed, and leaving out others beforehand changes no bit of the result.
void appendCone(const LightPyramid& pyramid, const Triangle& t, std::vector<Cone>& cones) {
    if (misses(pyramid, t)) return;
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double volume = glm::dot(t[0], normal);
    const double tolerance = (pyramid.rounding + 8.0 * epsilon * sumOfMagnitudes(t[0])) * glm::length(normal);
    if (std::abs(volume) <= tolerance) return;
    const double sign = volume > 0.0 ? 1.0 : -1.0;
    const Cone cone = {
        {sign * edgePlane(t[0], t[1]), sign * edgePlane(t[1], t[2]), sign * edgePlane(t[2], t[0])},
        sign * normal,
        t};
    if (isOutside(cone, pyramid.light, 3, tolerance) || misses(cone, pyramid.light)) return;
    cones.push_back(cone);
}

/// A piece that has grown many corners is halved along a diagonal, so that it always has room to be cut.
void halve(Polygon3& polygon, std::size_t next, std::vector<Piece>& pieces) {
    Polygon3 second;
    for (int i = polygon.count / 2; i < polygon.count; ++i) second.push(polygon[i]);
    second.push(polygon[0]);
    polygon.count = polygon.count / 2 + 1;
    pieces.push_back({second, next});
}

/// Form factor of the part of `piece` outside its cones, the listed ones up to `last`; parts that meet
/// further cones are put on the stack.
double subtract(const LightPyramid& pyramid, Piece piece, std::size_t last, Workspace& work) {
    Polygon3 inside, outside;
    for (std::size_t i = piece.next; i < last; ++i) {
        const Cone& cone = work.cones[work.listed[i]];
        if (misses(cone, piece.polygon)) continue;
        double sum = 0.0;
        for (int plane = 0; plane < 4; ++plane) {
            if (piece.polygon.count > Polygon3::capacity / 2) halve(piece.polygon, i, work.pieces);
            const auto side = [&](const glm::dvec3& p) { return cone.side(plane, p); };
            split(piece.polygon, side, inside, outside);
            if (i + 1 == last)
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

/// Normal of the plane through x that halves `polygon` across its longest diagonal from the first corner.
glm::dvec3 planeAcross(const Polygon3& polygon) {
    glm::dvec3 longest(0.0), middle(0.0);
    for (const glm::dvec3& p : polygon.span()) {
        const glm::dvec3 diagonal = p - polygon[0];
        if (glm::dot(diagonal, diagonal) > glm::dot(longest, longest)) longest = diagonal;
        middle += p;
    }
    return longest - middle * (glm::dot(longest, middle) / glm::dot(middle, middle));
}

/// Lists, behind the others, those of the cones [first, last) that reach into `part`, which lies on the
/// positive side of `plane`. False if one of them covers it.
bool listCones(const Polygon3& part, const glm::dvec3& plane, std::size_t first, std::size_t last,
               Workspace& work) {
    for (std::size_t i = first; i < last; ++i) {
        const Cone& cone = work.cones[work.listed[i]];
        const Triangle& t = cone.triangle;
        if (std::max({glm::dot(plane, t[0]), glm::dot(plane, t[1]), glm::dot(plane, t[2])}) <= 0.0) continue;
        if (misses(cone, part)) continue;
        if (covers(cone, part)) return false;
        work.listed.push_back(work.listed[i]);
    }
    return true;
}

/// Form factor of what the listed cones [first, last) leave of `part`. Every piece is tested against every
/// cone of its part, so a part with many cones is halved first: a thousand leaves then cost a hundred times
/// ten, not the square.
double visiblePart(const LightPyramid& pyramid, const Polygon3& part, std::size_t first, std::size_t last,
                   int halvings, Workspace& work) {
    constexpr std::size_t few = 12;
    double sum = 0.0;
    if (last - first <= few || halvings == 0) {
        sum += subtract(pyramid, {part, first}, last, work);
        while (!work.pieces.empty()) {
            const Piece piece = work.pieces.back();
            work.pieces.pop_back();
            sum += subtract(pyramid, piece, last, work);
        }
        return sum;
    }
    const glm::dvec3 plane = planeAcross(part);
    Polygon3 halves[2];
    split(
        part, [&](const glm::dvec3& p) { return glm::dot(plane, p); }, halves[0], halves[1]);
    for (int i = 0; i < 2; ++i) {
        const std::size_t begin = work.listed.size();
        if (!halves[i].empty() && listCones(halves[i], i == 0 ? plane : -plane, first, last, work))
            sum += visiblePart(pyramid, halves[i], begin, work.listed.size(), halvings - 1, work);
        work.listed.resize(begin);
    }
    return sum;
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
    // Outward, so that rounding never culls what the exact test would keep.
    const double slack = 1.0 + 16.0 * epsilon;
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
    for (const Triangle& t : occluders) {
        appendCone(pyramid, {t[0] - pyramid.x, t[1] - pyramid.x, t[2] - pyramid.x}, work.cones);
        if (!work.cones.empty() && covers(work.cones.back(), pyramid.light)) return 0.0;
    }
    const double whole = unoccludedFormFactor(pyramid);
    if (work.cones.empty()) return whole;
    work.listed.resize(work.cones.size());
    std::iota(work.listed.begin(), work.listed.end(), 0u);
    const double sum = visiblePart(pyramid, pyramid.light, 0, work.listed.size(), 10, work);
    // An occluder that hides next to nothing: the rounding of the pieces must not add light.
    return std::min(sum, whole);
}

}  // namespace penumbra
