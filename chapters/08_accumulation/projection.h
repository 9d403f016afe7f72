// The hard shadow of one light point, registered on a receiver: the matrix of Heckbert & Herf (1997).
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "chapters/08_accumulation/light_points.h"
#include "chapters/08_accumulation/receiver.h"

namespace penumbra {

/// Perspective from a light point onto a receiver's texture. In both matrices w = t: the fraction of the way
/// from the light (0) to the receiver's plane (1), negative behind the light, above 1 beyond the plane; for a
/// light at infinity w = 1 everywhere.
struct ReceiverProjection {
    /// (x/w, y/w) is (u, v) of the shadow of a point, in [0,1]^2 on the receiver. z/w is 1/t: 1 on the plane,
    /// infinite at the light (at infinity: z = 1 - height in metres).
    glm::dmat4 textureFromWorld{1.0};
    /// The same for rendering: x and y in [-w, w]; the near plane (t = `near`) clips what is behind the
    /// light, which would otherwise cast a false, mirrored shadow; the far plane (t = `far`) clips the
    /// receiver itself and what is beyond it.
    glm::dmat4 clipFromWorld{1.0};
    double near = 0.0;
    double far = 1.0;
    /// Rounding could lift the receiver's own plane half way to the light point, or more: `far` is not where
    /// it should be, and the receiver may shadow itself.
    bool tooLow = false;
};

/// What `near` to take when occluders may come up to the light: a thousandth of the way.
inline constexpr double nearestFraction = 1e-3;

/// The projection, or nothing if the light point lies in the receiver's plane or below it: it lights nothing.
///
/// `near` in (0, 1): occluders nearer to the light than this fraction of the way are cut off, so it must be
/// below the smallest t of any occluder (see reach.h); but the larger it is, the finer the far plane works:
/// `far` = 1 - the smallest distance at which a vertex shader in float can still tell an occluder from the
/// receiver, about 1e-7 / near. A larger `far` would let a receiver shadow itself in speckles; a smaller one
/// cuts objects off that touch it, and light shines through below them.
std::optional<ReceiverProjection> projectOnReceiver(const Receiver& receiver, const LightPoint& point,
                                                    double near = nearestFraction,
                                                    double highestOccluder = 0.0);

}  // namespace penumbra
