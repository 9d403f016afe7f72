#include "common/truth/cone_subtraction.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace penumbra {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// What a triangle hides, relative to x: the points in the infinite cone from x over it (three planes through
/// x, normals inward) and beyond its own plane. Asking the light's points for that, instead of cutting the
/// triangle off at the light's plane, needs no extra corners, and keeps its digits when x is nearly in the
/// light's plane.
struct Cone {
    std::array<glm::dvec3, 3> inward;
    glm::dvec3 beyond;  ///< the triangle's normal on the side away from x ...
    double offset;      ///< ... and its distance from x, both times twice the triangle's area
    Triangle triangle;

    /// >= 0 on the inner side of plane `i`; the planes of the cone are 0, 1, 2, the triangle's own is 3.
    double side(int i, const glm::dvec3& p) const {
        return i < 3 ? glm::dot(inward[std::size_t(i)], p) : glm::dot(beyond, p) - offset;
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

struct Plane {
    glm::dvec3 normal;  ///< times twice the area of its triangle
    double offset;      ///< of x: dot(normal, p) of the plane's points
};

/// The plane of `t`, computed in `Real`. Parts of one surface must have one plane, to well below the distance
/// of a wide light: so near to x, 53 bits of coordinates a metre away are not enough.
template <class Real>
Plane planeOf(const Triangle& t) {
    using Vector = glm::vec<3, Real>;
    const Vector a(t[0]);
    const Vector normal = glm::cross(Vector(t[1]) - a, Vector(t[2]) - a);
    return {glm::dvec3(normal), double(glm::dot(a, normal))};
}

/// Appends the cone over triangle `t` (relative to x), unless it can hide nothing of the light: beside the
/// pyramid; degenerate; behind the light or part of its surface; or with x in its plane as far as doubles can
/// tell (no surface shadows itself). So only triangles that do hide something have a say in the order in
/// which pieces are summed, and leaving out others beforehand changes no bit of the result.
void appendCone(const LightPyramid& pyramid, const Triangle& t, std::vector<Cone>& cones) {
    if (misses(pyramid, t)) return;
    const auto [normal, offset] = pyramid.wide ? planeOf<long double>(t) : planeOf<double>(t);
    const double tolerance = (pyramid.rounding + 8.0 * epsilon * sumOfMagnitudes(t[0])) * glm::length(normal);
    if (std::abs(offset) <= tolerance) return;
    const double sign = offset > 0.0 ? 1.0 : -1.0;
    const Cone cone = {
        {sign * edgePlane(t[0], t[1]), sign * edgePlane(t[1], t[2]), sign * edgePlane(t[2], t[0])},
        sign * normal,
        sign * offset,
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
                sum += formFactorOf(pyramid, outside);
            else if (!outside.empty())
                work.pieces.push_back({outside, i + 1});
            if (inside.empty()) break;
            piece.polygon = inside;
        }
        return sum;
    }
    return formFactorOf(pyramid, piece.polygon);
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

double visibleFormFactor(const LightPyramid& pyramid, std::span<const Triangle> occluders) {
    Workspace& work = workspace();
    work.cones.clear();
    for (const Triangle& t : occluders) {
        appendCone(pyramid, {t[0] - pyramid.x, t[1] - pyramid.x, t[2] - pyramid.x}, work.cones);
        if (!work.cones.empty() && covers(work.cones.back(), pyramid.light)) return 0.0;
    }
    const double whole = formFactorOf(pyramid, pyramid.light);
    if (work.cones.empty()) return whole;
    work.listed.resize(work.cones.size());
    std::iota(work.listed.begin(), work.listed.end(), 0u);
    const double sum = visiblePart(pyramid, pyramid.light, 0, work.listed.size(), 10, work);
    // An occluder that hides next to nothing: the rounding of the pieces must not add light.
    return std::min(sum, whole);
}

}  // namespace penumbra
