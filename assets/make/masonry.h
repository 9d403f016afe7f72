// What a mason makes: arcades, columns, stairs, paving, tiles, basins.
#pragma once

#include <vector>

#include "assets/make/random.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {

struct Arcade {
    int bays = 5;
    double bay = 2.0;     ///< metres from column to column
    double spring = 2.0;  ///< height at which the arches begin
    double top = 3.6;
    double thickness = 0.4;  ///< along z, centred on z = 0
    double pier = 0.2;       ///< half the width of wall that stands on one column
};
/// The wall above the columns, from x = 0 to bays * bay.
Mesh arcadeWall(const Arcade& arcade);
/// The moulding around one arch, centred on x = 0, proud of the wall on both sides.
Mesh archMoulding(const Arcade& arcade);
/// Column with base, swelling shaft and capital, `height` tall, on y = 0.
Mesh column(double height, double radius);
/// Square slabs below and above the column.
Mesh columnBlocks(double height, double radius);

/// Solid flight of stairs: climbs along -z from z = 0, from x = 0 to `width`, then a landing of `landing`
/// metres.
Mesh stairs(int steps, double rise, double run, double width, double landing);

/// Stones with tops at exactly y = 0 and small gaps, over [lower.x, upper.x] x [lower.y, upper.y] in x and z,
/// dealt into as many meshes as there are `tints`.
std::vector<Mesh> paving(Random& random, const Vec2& lower, const Vec2& upper, int tints);

/// One barrel tile of `length` along -z, `radius` wide on each side of x = 0.
Mesh barrelTile(double length, double radius);

/// Basin on y = 0: `sides` corners, `radius` outside, `wall` thick, open at the top, with a floor.
Mesh basin(int sides, double radius, double height, double wall);

/// Flower pot with a rim, filled with soil, `height` tall.
Mesh pot(double height, double radius);

}  // namespace penumbra::assets
