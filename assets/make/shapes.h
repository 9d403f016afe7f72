// Solids from a few numbers. All are closed and the right way out unless the comment says otherwise.
#pragma once

#include <functional>
#include <vector>

#include "assets/make/mesh.h"

namespace penumbra::assets {

using Ring = std::vector<Vec3>;
using Polygon = std::vector<Vec2>;

/// Skin over rings of equally many points. Rings follow one another along a direction d and run
/// counter-clockwise seen from where d points. Ends are closed by fans (so end rings must be convex), or
/// joined to each other with `joinEnds`.
Mesh loft(const std::vector<Ring>& rings, bool joinEnds = false);

Mesh box(const Vec3& lower, const Vec3& upper);
/// A box whose upper edges are cut off by `chamfer` metres: paving stones, treads.
Mesh chamferedBox(const Vec3& lower, const Vec3& upper, double chamfer);

/// Turns a profile of (radius, height), from bottom to top, around the y axis. The profile must begin and end
/// at radius 0, or be a loop (`loop`), counter-clockwise with radius to the right, height up.
Mesh lathe(const std::vector<Vec2>& profile, int segments, bool loop = false);

/// Sphere of `radius` around the origin with triangles of nearly equal size: an icosahedron, subdivided.
Mesh sphere(double radius, int subdivisions);

/// Pipe along a curve, `radius[i]` at point i (or one radius for all), with frames carried along without
/// twist (Hanson & Ma 1995). `joinEnds`: the curve is a loop (the last point is not a copy of the first).
Mesh tube(const std::vector<Vec3>& curve, const std::vector<double>& radius, int segments,
          bool joinEnds = false);

/// Straight round bar.
Mesh bar(const Vec3& from, const Vec3& to, double radius, int segments = 8);

/// Prism over a simple, perhaps concave, counter-clockwise polygon (x, y), from z = zLow to z = zHigh, its
/// sides cut into `slices` along z.
Mesh extrude(const Polygon& polygon, double zLow, double zHigh, int slices = 1);

/// Indices of triangles that fill a simple counter-clockwise polygon (ear clipping; Meisters 1975).
std::vector<glm::uvec3> triangulate(const Polygon& polygon);

/// Points on a smooth curve through `control` (Catmull & Rom 1974), `perSpan` per interval, both ends
/// included.
std::vector<Vec3> smoothCurve(const std::vector<Vec3>& control, int perSpan);

/// Two triangles, open: a, b, c, d counter-clockwise seen from the front.
Mesh openQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace penumbra::assets
