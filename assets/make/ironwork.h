// Thin things of metal: railings, wire netting, lanterns.
#pragma once

#include "assets/make/shapes.h"

namespace penumbra::assets {

/// Railing along x from 0 to `length`, `height` tall, feet on y = 0: posts at the ends, a hand rail, a foot
/// rail and upright bars about `spacing` apart. `rise`: height gained from one end to the other (stairs); the
/// bars stay upright.
Mesh railing(double length, double height, double spacing, double barRadius, double rise = 0.0);

/// One wire of a chain-link net: zigzags upwards along y between x = -pitch/2 and pitch/2, passing before and
/// behind its neighbours.
Mesh netWire(double height, double pitch, double wireRadius, bool startsLeft);

/// Lantern body that hangs from (0, 0, 0): eye, roof, four corner bars and a base ring, open between them,
/// `size` metres tall.
Mesh lantern(double size);

}  // namespace penumbra::assets
