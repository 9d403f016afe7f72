// A ground and triangles of any shape above it, in it and across it: for what must hold of every picture.
#pragma once

#include "tests/image/chapter_harness.h"
#include "tests/stress/case.h"

namespace penumbra::stress {

inline const std::vector<std::string> anySceneAxes{
    "chapter", "light-type", "depth-format", "shape",   "light-angle", "scale",      "distance",
    "aside",   "fov",        "map-size",     "picture", "radius",      "light-size", "variant"};

/// Axes: anySceneAxes. The ground is triangles 0 and 1. Chapter 08 gets an area light.
Scene anyScene(const Case& given);
/// The parameters that go with it: few samples, small textures.
Settings settingsOf(const Case& given);
/// What a chapter has to be kept apart for (see shown).
std::string programsOf(const Case& given);

}  // namespace penumbra::stress
