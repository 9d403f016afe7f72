// --method exact: the irradiance of every texel by cone subtraction, without samples and without error.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "chapters/08_accumulation/reach.h"
#include "chapters/08_accumulation/receiver.h"
#include "common/scene/scene.h"
#include "common/truth/parallel.h"

namespace penumbra {

/// Irradiance at the texel centres for a light of emission 1 (area light: radiance 1 W/(m^2 sr), pi times the
/// form factor), nothing in between: Lambert's formula. Times the light's emission it is W/m^2. Row 0 at v =
/// 0; on all cores. Relative error 1e-14.
std::vector<double> unoccludedIrradiance(const Receiver& receiver, const Light& light);

struct ExactIrradiance {
    std::vector<double> values;      ///< as unoccludedIrradiance
    std::int64_t shadowTexels = 0;   ///< texels that had triangles to look at
    std::int64_t triangleTests = 0;  ///< triangles looked at, summed over texels
};

/// The same behind `occluders` (Occluders::reaching). Exact: cone subtraction for area lights, a segment for
/// the others; exactly 0 behind one triangle. `cull`: each texel looks only at the triangles that reach into
/// its block of texels, most at none; the result is the same to the bit.
ExactIrradiance exactIrradiance(const Receiver& receiver, const Light& light,
                                std::span<const Triangle> occluders, bool cull = true,
                                const ProgressCallback& progress = {});

}  // namespace penumbra
