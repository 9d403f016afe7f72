// Leaves and what they grow on. Leaves are open sheets, seen and lit from both sides.
#pragma once

#include "assets/make/random.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {

/// Four triangles: a pointed leaf of `length` along +y and `width` along x, folded a little along its rib and
/// bent forwards (+z).
Mesh leaf(double length, double width);

/// An ivy leaf with five lobes, stalk at the origin, tip along +y, in the plane z = 0 with its rib raised.
Mesh ivyLeaf(double size);

/// A tuft: `count` leaves of about `length` in random directions around the origin, within `radius`.
Mesh leafCluster(Random& random, int count, double radius, double length);

/// Grass-like or palm-like plant: blades that rise from the origin and bend outwards.
Mesh bladePlant(Random& random, int count, double length, double width);

/// Ivy that climbs the plane z = 0 (leaves stand off towards +z): a stem along `path` with side shoots. The
/// stem is appended to `stems`, the leaves to `leaves`.
void growIvy(Random& random, const std::vector<Vec3>& path, double leafSize, double spread, int leafCount,
             Mesh& stems, Mesh& leaves);

struct Tree {
    Mesh wood;                ///< closed: trunk and branches, each closed by itself
    std::vector<Mat4> tufts;  ///< where tufts of leaves sit at the twigs' ends
};
/// A tree of about `height` metres on the origin: a leaning trunk that forks again and again.
Tree growTree(Random& random, double height, double trunkRadius);

}  // namespace penumbra::assets
