// One point of the sweep, and the subjects that are tried on it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/stress/axes.h"

namespace penumbra::stress {

/// A subject's name, and a value for each of its axes.
struct Case {
    std::string subject;
    std::map<std::string, double> values = {};

    double number(const std::string& axis) const { return values.at(axis); }
    int integer(const std::string& axis) const { return int(values.at(axis)); }
    const std::string& choice(const std::string& axis) const {
        return axisNamed(axis).choices.at(std::size_t(values.at(axis)));
    }
    bool operator==(const Case&) const = default;
};

/// What a subject says about one case.
struct Verdict {
    /// One line: what did not hold, by how much. None: everything held.
    std::optional<std::string> failure = {};
    /// One line: why the program refuses this case instead of answering. It counts as right.
    std::optional<std::string> refusal = {};
    /// Named figures of which the largest of all cases is reported: errors over their bounds, counts.
    std::map<std::string, double> measured = {};

    /// Keeps the first failure.
    void fail(const std::string& what) {
        if (!failure) failure = what;
    }
    void measure(const std::string& name, double value);
    /// Measures `value`, and fails if it is above `bound` or no number.
    void expectAtMost(const std::string& name, double value, double bound);
};

/// Something that must hold everywhere.
struct Subject {
    std::string name;               ///< kebab-case; --subject
    std::string claim;              ///< one sentence, for the page: what must hold
    std::vector<std::string> axes;  ///< of allAxes()
    std::function<Verdict(const Case&)>
        check;           ///< an exception is a failure; the same case, the same verdict
    double share = 1.0;  ///< of all cases, relative to the others: more for one that is cheap
};

/// All subjects of the program, by name. A file in subjects/ adds its own:
///     const AddSubject bias({.name = "bias", ...});
std::vector<Subject>& allSubjects();
struct AddSubject {
    explicit AddSubject(Subject subject);
};
/// Throws UsageError for an unknown name.
const Subject& subjectNamed(const std::string& name);

/// Every axis at its simplest value.
Case simplestCase(const Subject& subject);
/// Case `index` of `seed`: even ones anywhere in the ranges, odd ones at the ends of axes, at powers of two,
/// at simplest values, and just beside these.
Case drawCase(const Subject& subject, std::uint64_t seed, std::uint64_t index);

/// Runs the check; what it throws becomes its failure.
Verdict verdictOn(const Subject& subject, const Case& given);

/// The failing case with each axis moved as near to its simplest value as still fails, and rounded to as few
/// digits.
Case shrink(const Subject& subject, const Case& failing);

/// The flags of a case: "--subject bias --light-angle 89.2 --scale 1".
std::string flagsOf(const Case& given);
/// And back. Axes that are not given are at their simplest. Throws UsageError.
Case caseFrom(const std::vector<std::string>& flags);

}  // namespace penumbra::stress
