#include "tests/stress/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra::stress {

void Verdict::measure(const std::string& name, double value) {
    const auto [at, added] = measured.emplace(name, value);
    if (!added && !(at->second >= value)) at->second = value;
}

void Verdict::expectAtMost(const std::string& name, double value, double bound) {
    measure(name, value);
    if (!(value <= bound)) fail(fmt::format("{}: {:.6g}, at most {:.6g} expected", name, value, bound));
}

std::vector<Subject>& allSubjects() {
    static std::vector<Subject> subjects;
    return subjects;
}

AddSubject::AddSubject(Subject subject) {
    auto& all = allSubjects();
    const auto after =
        std::find_if(all.begin(), all.end(), [&](const Subject& other) { return other.name > subject.name; });
    all.insert(after, std::move(subject));
}

const Subject& subjectNamed(const std::string& name) {
    std::vector<std::string> names;
    for (const Subject& subject : allSubjects()) {
        if (subject.name == name) return subject;
        names.push_back(subject.name);
    }
    throw UsageError(
        fmt::format("--subject {}: must be one of {}{}", name, joinNames(names), didYouMean(name, names)));
}

Case simplestCase(const Subject& subject) {
    Case simplest{subject.name};
    for (const std::string& name : subject.axes) simplest.values[name] = axisNamed(name).simplest;
    return simplest;
}

Verdict verdictOn(const Subject& subject, const Case& given) {
    try {
        return subject.check(given);
    } catch (const std::exception& problem) {
        Verdict verdict;
        verdict.fail(fmt::format("an error: {}", problem.what()));
        return verdict;
    }
}

std::string flagsOf(const Case& given) {
    std::string flags = "--subject " + given.subject;
    for (const std::string& name : subjectNamed(given.subject).axes)
        flags += fmt::format(" --{} {}", name, axisNamed(name).text(given.values.at(name)));
    return flags;
}

Case caseFrom(const std::vector<std::string>& flags) {
    std::map<std::string, std::string> given;
    for (std::size_t i = 0; i < flags.size(); i += 2) {
        if (!flags[i].starts_with("--") || i + 1 == flags.size())
            throw UsageError(fmt::format("{}: a flag and its value were expected", flags[i]));
        given[flags[i].substr(2)] = flags[i + 1];
    }
    if (!given.contains("subject")) throw UsageError("--subject is missing: which one is the case of?");
    const Subject& subject = subjectNamed(given["subject"]);
    Case made = simplestCase(subject);
    for (const auto& [name, text] : given) {
        if (name == "subject") continue;
        const double value = axisNamed(name).parse(text);
        if (!made.values.contains(name))
            throw UsageError(
                fmt::format("--{}: subject {} has {}", name, subject.name, joinNames(subject.axes)));
        made.values[name] = value;
    }
    return made;
}

}  // namespace penumbra::stress
