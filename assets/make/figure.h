// The statue of the courtyard.
#pragma once

#include "assets/make/mesh.h"

namespace penumbra::assets {

/// A woman in a long robe with a jug on her shoulder, 1.7 m tall, standing on the origin, facing +z.
Mesh waterCarrier();

}  // namespace penumbra::assets
