#include "common/app/parameter_step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

constexpr double steps = 50.0;  // through a linear range

int stepped(int value, const Parameter& parameter, int direction) {
    const double range = parameter.high - parameter.low;
    double next = value + direction;
    if (isLogarithmic(parameter)) {
        next = direction > 0 ? 2.0 * value : std::floor(0.5 * value);
    } else if (range > 2.0 * steps) {
        next = value + direction * std::round(range / steps);
    }
    return int(std::clamp(next, parameter.low, parameter.high));
}

float stepped(float value, const Parameter& parameter, int direction) {
    const double next = isLogarithmic(parameter)
                            ? value * std::pow(std::numbers::sqrt2, direction)
                            : value + direction * (parameter.high - parameter.low) / steps;
    return float(std::clamp(next, parameter.low, parameter.high));
}

}  // namespace

bool isLogarithmic(const Parameter& parameter) {
    return parameter.low > 0.0 && parameter.high >= 100.0 * parameter.low;
}

void stepParameter(const Parameter& parameter, int direction) {
    if (auto* const* value = std::get_if<int*>(&parameter.value)) {
        **value = stepped(**value, parameter, direction);
    } else if (auto* const* real = std::get_if<float*>(&parameter.value)) {
        **real = stepped(**real, parameter, direction);
    } else if (auto* const* flag = std::get_if<bool*>(&parameter.value)) {
        **flag = !**flag;
    } else {
        std::string& text = *std::get<std::string*>(parameter.value);
        const auto& choices = parameter.choices;
        const auto found = std::find(choices.begin(), choices.end(), text);
        const auto now = found == choices.end() ? 0 : found - choices.begin();  // a file: from the first on
        const auto count = std::ptrdiff_t(choices.size());
        text = choices[std::size_t((now + direction + count) % count)];
    }
}

void resetParameter(const Parameter& parameter) {
    std::visit(
        [&](auto* value) {
            *value = std::get<std::remove_pointer_t<decltype(value)>>(parameter.defaultValue);
        },
        parameter.value);
}

}  // namespace penumbra
