// Convex polygons of bounded size on the stack, and the one clipper everything exact is built from.
//
// Sutherland & Hodgman, "Reentrant Polygon Clipping", CACM 1974. A cut vertex is always computed from the end
// of the edge that is nearer to it, so two polygons that share an edge, in whichever direction, are cut at
// the same bits: no cracks. And near the origin, where the exact answers have their receiver point, the cut
// vertex of an edge that leads far away keeps its digits.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <span>

namespace penumbra {

[[noreturn]] void throwPolygonOverflow();

/// Up to `capacity` vertices in order around the polygon. `Point` is any glm vector: 2-D, 3-D, or
/// homogeneous. No heap: cutting millions of these is the hot path of the exact answers.
template <class Point>
struct ConvexPolygon {
    /// A half-space adds at most one vertex to a convex polygon; when rounding spoils convexity by a hair, at
    /// most as many as it has. So a polygon of up to capacity/2 vertices can always be cut once.
    static constexpr int capacity = 24;

    int count = 0;
    std::array<Point, capacity> vertices;

    ConvexPolygon() = default;
    explicit ConvexPolygon(std::span<const Point> points) {
        for (const Point& p : points) push(p);
    }
    // Only the vertices in use are copied: a quad is 96 bytes, not 580.
    ConvexPolygon(const ConvexPolygon& other) : count(other.count) {
        std::copy_n(other.vertices.begin(), count, vertices.begin());
    }
    ConvexPolygon& operator=(const ConvexPolygon& other) {
        count = other.count;
        std::copy_n(other.vertices.begin(), count, vertices.begin());
        return *this;
    }

    bool empty() const { return count == 0; }
    const Point& operator[](int i) const { return vertices[std::size_t(i)]; }
    Point& operator[](int i) { return vertices[std::size_t(i)]; }
    int next(int i) const { return i + 1 == count ? 0 : i + 1; }
    void push(const Point& p) {
        if (count == capacity) throwPolygonOverflow();
        vertices[std::size_t(count++)] = p;
    }
    std::span<const Point> span() const& { return {vertices.data(), std::size_t(count)}; }
    std::span<const Point> span() const&& = delete;  // it would outlive the polygon
};

using Polygon2 = ConvexPolygon<glm::dvec2>;
using Polygon3 = ConvexPolygon<glm::dvec3>;

/// Where the segment from `in` (distance sIn > 0) to `out` (distance sOut < 0) meets distance 0.
template <class Point>
Point crossing(const Point& in, double sIn, const Point& out, double sOut) {
    const double whole = sIn - sOut;
    return sIn < -sOut ? in + (out - in) * (sIn / whole) : out + (in - out) * (-sOut / whole);
}

/// Cuts `polygon` where `distance(vertex)` changes sign (it must be linear in the vertex) into the parts >= 0
/// and <= 0. Both get the same cut vertices, so together they cover the polygon exactly once. A part without
/// area has no vertices.
template <class Point, class Distance>
void split(const ConvexPolygon<Point>& polygon, const Distance& distance, ConvexPolygon<Point>& inside,
           ConvexPolygon<Point>& outside) {
    inside.count = outside.count = 0;
    if (polygon.empty()) return;
    const Point* previous = &polygon[polygon.count - 1];
    double previousSide = distance(*previous);
    for (int i = 0; i < polygon.count; ++i) {
        const Point* current = &polygon[i];
        const double side = distance(*current);
        if ((previousSide > 0.0 && side < 0.0) || (previousSide < 0.0 && side > 0.0)) {
            const Point cut = side < 0.0 ? crossing(*previous, previousSide, *current, side)
                                         : crossing(*current, side, *previous, previousSide);
            inside.push(cut);
            outside.push(cut);
        }
        if (side >= 0.0) inside.push(*current);
        if (side <= 0.0) outside.push(*current);
        previous = current;
        previousSide = side;
    }
    if (inside.count < 3) inside.count = 0;
    if (outside.count < 3) outside.count = 0;
}

/// The part of `polygon` with distance >= 0.
template <class Point, class Distance>
ConvexPolygon<Point> clip(const ConvexPolygon<Point>& polygon, const Distance& distance) {
    ConvexPolygon<Point> inside, outside;
    split(polygon, distance, inside, outside);
    return inside;
}

/// Signed area, positive counter-clockwise. Differences to the first vertex are formed first, so a small
/// polygon far from the origin keeps its digits.
double area(const Polygon2& polygon);

/// Twice the area times the unit normal of the front (counter-clockwise) side, by Newell's method about the
/// first vertex.
glm::dvec3 areaNormal(std::span<const glm::dvec3> polygon);

}  // namespace penumbra
