#include "tests/stress/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra::stress {
namespace {

using Kind = Axis::Kind;

constexpr int equalBins = 10;

/// Decades of a wide range, octaves of a narrow one.
double binBase(const Axis& axis) {
    return axis.high / axis.low >= 1e3 ? 10.0 : 2.0;
}

int powerBelow(double value, double base) {
    // A last bit of the logarithm must not move an exact power into the piece below.
    return int(std::floor(std::log(value) / std::log(base) + 1e-12));
}

Axis choice(const char* name, const char* help, std::vector<std::string> choices) {
    return {.name = name, .unit = "", .help = help, .kind = Kind::choice, .choices = std::move(choices)};
}

std::vector<Axis> makeAxes() {
    return {
        choice("chapter", "which chapter draws",
               {"02", "03", "04", "05", "06", "07", "08", "10", "11", "00", "01", "09"}),
        choice("filter", "which chapter filters", {"04", "05", "06", "07"}),
        choice("kernel", "what is tested around a point: chapters 03, 04, 04 blended, 05 and 06",
               {"point", "square", "blended", "disk", "jitter"}),
        choice("light-type", "kind of light", {"directional", "spot", "point"}),
        choice("method", "how the bias is spent",
               {"slope", "receiver-plane", "normal-offset", "polygon-offset"}),
        choice("depth-format", "bits of the shadow map", {"24", "16", "32f", "32f-reversed"}),
        choice("shape", "triangles of the scene",
               {"ordinary", "needle", "sliver", "degenerate", "coplanar", "coincident", "interpenetrating"}),
        {.name = "light-angle",
         .unit = "degrees",
         .help = "between the light and the receiver's normal; 90 would graze it",
         .high = 89.9},
        {.name = "scale",
         .unit = "",
         .help = "size of everything, lights and cameras included",
         .low = 1e-6,
         .high = 1e6,
         .logarithmic = true,
         .simplest = 1.0},
        {.name = "distance",
         .unit = "metres",
         .help = "of the scene from the origin of its coordinates, along a diagonal",
         .low = 1e-3,
         .high = 1e8,
         .logarithmic = true,
         .orZero = true},
        {.name = "aside",
         .unit = "",
         .help = "of the scene from the origin of its floats, in scene sizes: what a loader cannot subtract",
         .low = 1e-2,
         .high = 1e7,
         .logarithmic = true,
         .orZero = true},
        {.name = "fov",
         .unit = "degrees",
         .help = "full angle: of the spot light, or of the camera",
         .low = 1.0,
         .high = 170.0,
         .simplest = 45.0},
        {.name = "map-size",
         .unit = "texels",
         .help = "side of the shadow map",
         .kind = Kind::integer,
         .low = 16,
         .high = 512,
         .logarithmic = true,
         .simplest = 64},
        {.name = "picture",
         .unit = "pixels",
         .help = "side of the picture",
         .kind = Kind::integer,
         .low = 1,
         .high = 64,
         .logarithmic = true,
         .simplest = 16},
        {.name = "near-far",
         .unit = "",
         .help = "distance of the first caster over that of the last receiver, both from the light",
         .low = 1e-6,
         .high = 0.99,
         .logarithmic = true,
         .simplest = 0.5},
        {.name = "light-size",
         .unit = "",
         .help = "side of an area light over its distance",
         .low = 1e-6,
         .high = 1e2,
         .logarithmic = true,
         .simplest = 0.5},
        {.name = "samples",
         .unit = "",
         .help = "taps, rays, or points on the light",
         .kind = Kind::integer,
         .low = 1,
         .high = 256,
         .logarithmic = true,
         .simplest = 16},
        {.name = "radius",
         .unit = "texels",
         .help = "of a filter",
         .low = 0.01,
         .high = 24.0,
         .logarithmic = true,
         .orZero = true,
         .simplest = 2.0},
        {.name = "variant",
         .unit = "",
         .help = "which way everything is turned, and whatever else has no axis of its own",
         .kind = Kind::integer,
         .low = 0,
         .high = 999},
    };
}

}  // namespace

bool Axis::holds(double value) const {
    if (kind == Kind::choice)
        return value >= 0 && value < double(choices.size()) && value == std::floor(value);
    if (orZero && value == 0.0) return true;
    return value >= low && value <= high && (kind != Kind::integer || value == std::floor(value));
}

std::string Axis::text(double value) const {
    return kind == Kind::choice ? choices.at(std::size_t(value)) : fmt::format("{}", value);
}

double Axis::parse(const std::string& text) const {
    if (kind == Kind::choice) {
        const auto found = std::find(choices.begin(), choices.end(), text);
        if (found != choices.end()) return double(found - choices.begin());
        throw UsageError(fmt::format("--{} {}: must be one of {}", name, text, joinNames(choices)));
    }
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !holds(value))
        throw UsageError(fmt::format("--{} {}: must be {} from {} to {}{}", name, text,
                                     kind == Kind::integer ? "a whole number" : "a number", low, high,
                                     orZero ? ", or 0" : ""));
    return value;
}

std::vector<std::string> Axis::binNames() const {
    if (kind == Kind::choice) return choices;
    std::vector<std::string> names;
    if (orZero) names.emplace_back("0");
    if (logarithmic) {
        const double base = binBase(*this);
        for (int power = powerBelow(low, base); power <= powerBelow(high, base); ++power)
            names.push_back(fmt::format("{:g}", std::max(low, std::pow(base, power))));
        return names;
    }
    for (int i = 0; i < equalBins; ++i)
        names.push_back(fmt::format("{:.4g}", low + (high - low) * i / equalBins));
    return names;
}

std::size_t Axis::bin(double value) const {
    if (kind == Kind::choice) return std::size_t(value);
    if (orZero && value == 0.0) return 0;
    const std::size_t first = orZero ? 1 : 0;
    if (logarithmic) {
        const double base = binBase(*this);
        return first + std::size_t(std::max(0, powerBelow(value, base) - powerBelow(low, base)));
    }
    return first + std::size_t(std::min(double(equalBins - 1), equalBins * (value - low) / (high - low)));
}

const std::vector<Axis>& allAxes() {
    static const std::vector<Axis> axes = makeAxes();
    return axes;
}

const Axis& axisNamed(const std::string& name) {
    std::vector<std::string> names;
    for (const Axis& axis : allAxes()) {
        if (axis.name == name) return axis;
        names.push_back(axis.name);
    }
    throw UsageError(fmt::format("--{}: there is no such flag{}", name, didYouMean(name, names)));
}

}  // namespace penumbra::stress
