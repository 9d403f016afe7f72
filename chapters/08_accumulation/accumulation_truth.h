// The exact answers of chapter 08.
#pragma once

#include "chapters/08_accumulation/accumulation_options.h"
#include "common/app/chapter.h"

namespace penumbra {

/// Of the views visibility, irradiance and color, for the lights as `options` has them lit: cone subtraction
/// and Lambert's formula in double. Color is the diffuse reflection of that irradiance, plus emission and
/// ambient term. UsageError for other views.
TruthImage accumulationTruth(const TruthRequest& request, const AccumulationOptions& options);

}  // namespace penumbra
