// The environment maps: one function each.
#pragma once

#include "assets/make/hdr_writer.h"

namespace penumbra::assets {

/// A clear day: blue above, bright at the horizon, dry ground, and a sun 50 degrees high that gives twice as
/// much as the sky. It is 5 degrees wide where the real one has half a degree.
Environment makeClearSky();

/// Indoors: a dim nave, three tall windows on one side, a round one at an end, and a lamp; some hundred times
/// brighter than the walls.
Environment makeChapel();

}  // namespace penumbra::assets
