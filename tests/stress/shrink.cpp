// From a failing case to the simplest one that still fails.
#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "tests/stress/case.h"

namespace penumbra::stress {
namespace {

constexpr int mostTries =
    400;  // of the check: a case that takes a tenth of a second is shrunk in less than a minute
constexpr int bisections = 12;  // of a range of twelve decades: to a hundredth of one
constexpr int mostDigits = 6;

class Shrinker {
 public:
    Shrinker(const Subject& subject, const Case& failing) : subject_(subject), best_(failing) {}

    Case run() {
        // Simplifying one axis may free another: again, until nothing changes.
        for (Case before; before != best_ && triesLeft_ > 0;) {
            before = best_;
            for (const std::string& name : subject_.axes) simplify(axisNamed(name));
        }
        return best_;
    }

 private:
    /// Takes `value` for the axis if the case still fails.
    bool fails(const Axis& axis, double value) {
        if (value == best_.values[axis.name]) return true;
        if (!axis.holds(value) || triesLeft_-- <= 0) return false;
        Case tried = best_;
        tried.values[axis.name] = value;
        if (!verdictOn(subject_, tried).failure) return false;
        best_ = tried;
        return true;
    }

    void simplify(const Axis& axis) {
        if (fails(axis, axis.simplest)) return;
        if (axis.kind == Axis::Kind::choice) {
            for (double earlier = 0; earlier < best_.values[axis.name]; ++earlier)
                if (fails(axis, earlier)) return;
            return;
        }
        bisect(axis);
        if (axis.kind == Axis::Kind::number) shorten(axis);
    }

    void bisect(const Axis& axis) {
        double holds = axis.simplest;
        for (int i = 0; i < bisections; ++i) {
            const double failing = best_.values[axis.name];
            const double middle = between(axis, holds, failing);
            if (middle == holds || middle == failing) return;
            if (!fails(axis, middle)) holds = middle;
        }
    }

    static double between(const Axis& axis, double a, double b) {
        double middle = 0.5 * (a + b);
        if (axis.logarithmic) middle = std::sqrt(std::max(a, axis.low) * std::max(b, axis.low));
        return axis.kind == Axis::Kind::integer ? std::round(middle) : middle;
    }

    void shorten(const Axis& axis) {
        for (int digits = 1; digits <= mostDigits; ++digits) {
            const std::string text = fmt::format("{:.{}g}", best_.values[axis.name], digits);
            double shorter = 0.0;
            std::from_chars(text.data(), text.data() + text.size(), shorter);
            if (fails(axis, shorter)) return;
        }
    }

    const Subject& subject_;
    Case best_;
    int triesLeft_ = mostTries;
};

}  // namespace

Case shrink(const Subject& subject, const Case& failing) {
    return Shrinker(subject, failing).run();
}

}  // namespace penumbra::stress
