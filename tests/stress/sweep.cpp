#include "tests/stress/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/clocks.h"

namespace penumbra::stress {
namespace {

constexpr std::size_t mostShrunk = 3;    // failures of a subject: the rest is counted
constexpr std::size_t mostRefusals = 8;  // different ones of a subject

void count(SubjectResult& result, const Case& given, const Verdict& verdict) {
    const auto add = [&verdict](auto& to) {
        ++to.cases;
        to.refused += verdict.refusal.has_value();
        to.failed += verdict.failure.has_value();
    };
    add(result);
    if (verdict.refusal &&
        (result.refusals.size() < mostRefusals || result.refusals.contains(*verdict.refusal)))
        ++result.refusals[*verdict.refusal];
    for (const auto& [name, value] : verdict.measured) {
        const auto [at, added] = result.worst.try_emplace(name, Worst{value, given});
        if (!added && !(value <= at->second.value)) at->second = {value, given};
    }
    for (const auto& [name, value] : given.values) {
        const Axis& axis = axisNamed(name);
        auto& bins = result.bins[name];
        if (bins.empty()) bins.resize(axis.binNames().size());
        BinResult& bin = bins.at(axis.bin(value));
        add(bin);
        for (const auto& [what, size] : verdict.measured) {
            const auto [at, added] = bin.worst.emplace(what, size);
            if (!added && !(size <= at->second)) at->second = size;
        }
    }
}

Failure shrunkFailure(const Subject& subject, const Case& drawn) {
    const Case shrunk = shrink(subject, drawn);
    // Shrunk or not, it failed a moment ago; a check that has changed its mind is worth a line as well.
    return {drawn, shrunk,
            verdictOn(subject, shrunk).failure.value_or("failed once, and not when it was tried again")};
}

/// How many cases each subject gets.
std::vector<std::uint64_t> quotas(const SweepRequest& request) {
    double shares = 0.0;
    for (const Subject* subject : request.subjects) shares += subject->share;
    std::vector<std::uint64_t> result;
    for (const Subject* subject : request.subjects)
        result.push_back(std::max<std::uint64_t>(
            1, std::uint64_t(std::ceil(double(request.cases) * subject->share / shares))));
    return result;
}

void runOne(SubjectResult& result, const SweepRequest& request) {
    const double start = cpuTime();
    Case drawn = drawCase(*result.subject, request.seed, result.cases);
    for (const auto& [axis, value] : request.pinned)
        if (drawn.values.contains(axis)) drawn.values[axis] = value;
    const Verdict verdict = verdictOn(*result.subject, drawn);
    count(result, drawn, verdict);
    if (verdict.failure && result.failures.size() < mostShrunk) {
        result.failures.push_back(shrunkFailure(*result.subject, drawn));
        const Failure& failure = result.failures.back();
        request.say(fmt::format("FAILED {}\n  {}", failure.what, commandLine(failure.shrunk)));
    }
    result.cpuSeconds += 1e-3 * (cpuTime() - start);
}

}  // namespace

SweepResult sweep(const SweepRequest& request) {
    SweepResult result;
    result.seed = request.seed;
    for (const Subject* subject : request.subjects) result.subjects.push_back({subject});
    const std::vector<std::uint64_t> wanted = quotas(request);
    std::uint64_t all = 0;
    for (const std::uint64_t quota : wanted) all += quota;
    const double start = wallTime();
    while (result.cases < all && !result.interrupted) {
        // The one that is furthest behind: stopped at any moment, every subject has had its share.
        std::size_t next = 0;
        const auto done = [&](std::size_t i) { return double(result.subjects[i].cases) / double(wanted[i]); };
        for (std::size_t i = 1; i < wanted.size(); ++i)
            if (done(i) < done(next)) next = i;
        runOne(result.subjects[next], request);
        ++result.cases;
        request.progress(double(result.cases) / double(all));
        result.interrupted = request.stop();
    }
    for (const SubjectResult& subject : result.subjects) {
        result.refused += subject.refused;
        result.failed += subject.failed;
        result.cpuSeconds += subject.cpuSeconds;
    }
    result.seconds = 1e-3 * (wallTime() - start);
    return result;
}

}  // namespace penumbra::stress
