// What a stress case is drawn from: named axes, each with its range and its simplest value.
#pragma once

#include <string>
#include <vector>

namespace penumbra::stress {

struct Axis {
    enum class Kind { choice, number, integer };

    std::string name;  ///< the flag without its dashes
    std::string unit;  ///< "degrees", "texels", "" (pure number)
    std::string help;  ///< what it does to a scene
    Kind kind = Kind::number;
    std::vector<std::string> choices = {};  ///< of a choice, the simplest first; its value is the index
    double low = 0.0;                       ///< inclusive range of a number
    double high = 0.0;
    bool logarithmic = false;  ///< drawn evenly per decade; low > 0
    bool orZero = false;       ///< 0 is allowed too, below a logarithmic range
    double simplest = 0.0;  ///< where a shrunk case ends up if this axis has nothing to do with the failure

    bool holds(double value) const;
    /// What a reader types: "0.1", "32f-reversed". Reads back to the same value, to the bit.
    std::string text(double value) const;
    /// Throws UsageError: not a number, out of range, no such choice.
    double parse(const std::string& text) const;

    /// Names of the pieces whose cases are counted: choices, decades or octaves, else ten equal parts.
    std::vector<std::string> binNames() const;
    std::size_t bin(double value) const;
};

/// All axes there are. A subject names those that it uses; one that needs another adds it here.
const std::vector<Axis>& allAxes();
/// Throws UsageError for an unknown name.
const Axis& axisNamed(const std::string& name);

}  // namespace penumbra::stress
