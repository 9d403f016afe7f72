// Which cases are tried.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "tests/stress/case.h"

namespace penumbra::stress {
namespace {

/// Vigna's splitmix64: a sequence of well-mixed numbers from any start.
class Random {
 public:
    explicit Random(std::uint64_t state) : state_(state) {}
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double unit() { return double(bits() >> 11) * 0x1p-53; }
    std::size_t below(std::size_t count) { return std::size_t(unit() * double(count)); }

 private:
    std::uint64_t state_;
};

std::uint64_t hash(std::string_view text, std::uint64_t start) {  // FNV-1a
    for (const char c : text) start = (start ^ std::uint8_t(c)) * 0x100000001b3u;
    return start;
}

double anywhere(const Axis& axis, Random& random) {
    if (axis.kind == Axis::Kind::choice) return double(random.below(axis.choices.size()));
    if (axis.orZero && random.unit() < 0.05) return 0.0;
    const double u = random.unit();
    const double value = axis.logarithmic ? axis.low * std::pow(axis.high / axis.low, u)
                                          : axis.low + (axis.high - axis.low) * u;
    return std::clamp(axis.kind == Axis::Kind::integer ? std::round(value) : value, axis.low, axis.high);
}

/// A power of two in the range; the ends if there is none.
double powerOfTwo(const Axis& axis, Random& random) {
    const double from = std::max(axis.low, axis.kind == Axis::Kind::integer ? 1.0 : axis.high * 0x1p-60);
    const int first = int(std::ceil(std::log2(from))), last = int(std::floor(std::log2(axis.high)));
    if (first > last) return axis.high;
    return std::ldexp(1.0, first + int(random.below(std::size_t(last - first + 1))));
}

/// One step away: of an integer 1, of a number the last bit of a float or of a double.
double beside(const Axis& axis, double value, Random& random) {
    const double side = random.unit() < 0.5 ? -1.0 : 1.0;
    if (axis.kind == Axis::Kind::integer) return value + side;
    if (random.unit() < 0.5) return std::nextafter(value, side * std::numeric_limits<double>::infinity());
    return value + side * std::max(std::abs(value), axis.low) * 0x1p-23;
}

double atAnEdge(const Axis& axis, Random& random) {
    if (axis.kind == Axis::Kind::choice) return anywhere(axis, random);
    double value = axis.simplest;
    switch (random.below(5)) {
        case 0:
            value = axis.orZero ? 0.0 : axis.low;
            break;
        case 1:
            value = axis.low;
            break;
        case 2:
            value = axis.high;
            break;
        case 3:
            value = powerOfTwo(axis, random);
            break;
        default:
            break;
    }
    if (random.unit() < 0.4) value = beside(axis, value, random);
    return axis.orZero && value == 0.0 ? 0.0 : std::clamp(value, axis.low, axis.high);
}

}  // namespace

Case drawCase(const Subject& subject, std::uint64_t seed, std::uint64_t index) {
    Case drawn{subject.name};
    // A stream for each axis: a new axis leaves the values of the others as they were.
    for (const std::string& name : subject.axes) {
        Random random(hash(name, hash(subject.name, Random(seed ^ Random(index).bits()).bits())));
        const Axis& axis = axisNamed(name);
        // Not every axis of an adversarial case: an extreme of one often hides what another would do.
        const bool edge = index % 2 == 1 && random.unit() < 0.6;
        drawn.values[name] = edge ? atAnEdge(axis, random) : anywhere(axis, random);
    }
    return drawn;
}

}  // namespace penumbra::stress
