// The sides of receivers that get light: what the picture shows, and what is looked at to know what it shows.
#pragma once

#include <functional>
#include <vector>

#include "chapters/08_accumulation/receiver.h"

namespace penumbra {

/// Calls `draw(i)` for each receiver that is `lit(i)`, in their order, so that what it draws is the side that
/// receives and no other. Over what is drawn already, of the same depths too: of sides that coincide the last
/// is seen. All who draw them must agree on that to the pixel, or a texture of light that the picture looks
/// up is taken for unseen and never filled: a black hole. Leaves the defaults: no culling, GL_LESS.
void drawLitSides(const std::vector<Receiver>& receivers, const std::function<bool(std::size_t)>& lit,
                  const std::function<void(std::size_t)>& draw);

}  // namespace penumbra
