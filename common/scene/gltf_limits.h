// How much a glTF file may ask for. A few hundred bytes can name billions of vertices, nest a million nodes,
// or show one mesh a million times: every such amplifier meets one of these numbers, with an error that says
// so.
#pragma once

#include <cstddef>
#include <cstdint>

namespace penumbra::gltf {

constexpr std::uint64_t maxFileBytes = (std::uint64_t(1) << 31) - 1;  ///< one .gltf, .glb or external file
constexpr std::uint64_t maxExternalBytes = std::uint64_t(1) << 32;    ///< all external files together
constexpr int maxJsonDepth = 64;                                      ///< valid glTF nests about 12 deep
constexpr std::size_t maxJsonValues = 4'000'000;  ///< numbers, strings, objects ... that are kept
constexpr std::size_t maxObjects = 500'000;       ///< entries of one top-level array, such as "nodes"
constexpr std::size_t maxTriangles = 20'000'000;  ///< in the flattened scene
constexpr std::size_t maxZeroElements =
    1'000'000;  ///< of an accessor without bytes (all zero, as the specification says)
/// Accessor elements decoded in all. A part decodes its accessors anew, so a file of a thousand parts that
/// share one big accessor costs a thousand times its size in time (never in memory).
constexpr std::uint64_t maxElementsRead = 400'000'000;
constexpr std::size_t maxTexturePixels = std::size_t(1) << 26;  ///< of all base colour textures together
constexpr std::size_t maxEmitterTriangles = 4096;               ///< of one area light

}  // namespace penumbra::gltf
