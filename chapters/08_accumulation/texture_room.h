// What the textures of light need of memory.
#pragma once

#include <cstdint>
#include <vector>

#include "chapters/08_accumulation/accumulation_options.h"
#include "chapters/08_accumulation/receiver.h"

namespace penumbra {

/// At most this many bytes, 1 GiB: all of it is written to, and a machine that swaps looks as if it hung.
inline constexpr std::int64_t mostTextureBytes = std::int64_t(1) << 30;

/// Bytes of all textures of `receivers` at once, if each light casts shadows on each of them: its masks (a
/// bit for each texel and light point) or sums, its unoccluded light, and the light that is shown.
std::int64_t textureBytes(const AccumulationOptions& options, const Scene& scene,
                          const std::vector<Receiver>& receivers);

/// Throws UsageError, before anything is allocated, if that is more than `mostTextureBytes`.
void requireTextureRoom(const AccumulationOptions& options, const Scene& scene,
                        const std::vector<Receiver>& receivers);

}  // namespace penumbra
