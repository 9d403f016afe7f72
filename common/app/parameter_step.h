// Changing a parameter from the keyboard.
#pragma once

#include <vector>

#include "common/app/parameters.h"

namespace penumbra {

/// One key press: `direction` +1 or -1. A switch toggles, a choice goes round, a number stays in its range:
/// small integer ranges step by 1, wide positive ones double and halve (map sizes, sample counts); floats
/// step by a fiftieth of their range, or by a factor of the square root of 2 where the range spans more than
/// two decades.
void stepParameter(const Parameter& parameter, int direction);

/// Back to what was declared.
void resetParameter(const Parameter& parameter);

/// Positive and spanning two decades or more: best moved by factors.
bool isLogarithmic(const Parameter& parameter);

}  // namespace penumbra
