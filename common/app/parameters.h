// A chapter's parameters, each declared once: it becomes a flag, a slider, a column of the report, an axis of
// the benchmark. And its skips, which are declared and switched beside them.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "common/app/skips.h"

namespace penumbra {

/// One declared parameter; `value` points into the chapter's own struct.
struct Parameter {
    std::string name;  ///< kebab-case, the flag without dashes
    std::string help;  ///< one sentence: meaning, and the symptom at each end
    std::string unit;  ///< "texels", "degrees", "metres", "" (pure number)
    std::variant<int*, float*, bool*, std::string*> value;
    double low = 0.0;  ///< inclusive range of int and float
    double high = 0.0;
    std::vector<std::string> choices;  ///< of a string parameter
    std::variant<int, float, bool, std::string> defaultValue;
    bool orFile = false;  ///< of a string parameter: the path of a file is allowed too
};

class Parameters {
 public:
    void add(const std::string& name, int& value, int low, int high, const std::string& unit,
             const std::string& help);
    void add(const std::string& name, float& value, float low, float high, const std::string& unit,
             const std::string& help);
    void add(const std::string& name, bool& value, const std::string& help);
    void add(const std::string& name, std::string& value, std::vector<std::string> choices,
             const std::string& help);
    /// One of the choices, or the path of a file, which has a dot or a slash in it. Whether there is such a
    /// file is for the chapter to say.
    void addOrFile(const std::string& name, std::string& value, std::vector<std::string> choices,
                   const std::string& help);

    const std::vector<Parameter>& all() const { return parameters_; }
    /// Sets from text. Throws UsageError: unknown name, not a number, NaN, out of range (and says the range),
    /// no such choice.
    void set(const std::string& name, const std::string& text);
    /// For the report and --list-parameters.
    std::string toJson(bool valuesOnly) const;

    Skips& skips() { return skips_; }
    const Skips& skips() const { return skips_; }

 private:
    std::vector<Parameter> parameters_;
    Skips skips_;
};

/// The shortest decimal that is this value in single precision: "0.1", "512", "1e-06".
std::string shortNumber(double value);

}  // namespace penumbra
