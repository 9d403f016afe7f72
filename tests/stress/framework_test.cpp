// The machinery of the stress sweep: what it draws, how it shrinks, and that a case can be run again.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "common/error.h"
#include "tests/stress/projected_triangle.h"
#include "tests/stress/sweep.h"

namespace penumbra::stress {
namespace {

/// Fails when the scene is both large and far away, whatever else; counts how often it was asked.
int asked = 0;
Verdict plantedCheck(const Case& given) {
    ++asked;
    Verdict verdict;
    verdict.measure("product", given.number("scale") * given.number("distance"));
    if (given.choice("shape") == "needle") verdict.refusal = "needles are refused";
    if (given.number("scale") >= 300.0 && given.number("distance") >= 1e5 && given.integer("map-size") > 40 &&
        given.choice("depth-format") != "24")
        verdict.fail("planted");
    return verdict;
}
const AddSubject planted({.name = "planted",
                          .claim = "a fault for the shrinker to find",
                          .axes = {"scale", "distance", "map-size", "depth-format", "shape", "fov"},
                          .check = plantedCheck});
const AddSubject throwing({.name = "throwing",
                           .claim = "an exception is a failure",
                           .axes = {"fov"},
                           .check = [](const Case&) -> Verdict {
                               throw std::runtime_error("no such luck");
                           }});

std::vector<std::string> wordsOf(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

TEST(StressAxes, EveryValueReadsBackFromItsText) {
    for (const Axis& axis : allAxes()) {
        EXPECT_TRUE(axis.holds(axis.simplest)) << axis.name;
        const Subject only{.name = "only", .claim = "", .axes = {axis.name}, .check = {}};
        for (int i = 0; i < 200; ++i) {
            const double value = drawCase(only, 7, i).number(axis.name);
            ASSERT_TRUE(axis.holds(value)) << axis.name << " " << axis.text(value);
            EXPECT_EQ(axis.parse(axis.text(value)), value) << axis.name;
            EXPECT_LT(axis.bin(value), axis.binNames().size()) << axis.name << " " << axis.text(value);
        }
    }
}

TEST(StressAxes, RefuseWhatTheyDoNotHold) {
    for (const char* text : {"", "x", "1x", "nan", "inf", "-1", "1e9", "0"})
        EXPECT_THROW(axisNamed("scale").parse(text), UsageError) << text;
    EXPECT_EQ(axisNamed("distance").parse("0"), 0.0);
    EXPECT_THROW(axisNamed("map-size").parse("64.5"), UsageError);
    EXPECT_THROW(axisNamed("shape").parse("round"), UsageError);
    EXPECT_THROW(axisNamed("sacle"), UsageError);
}

TEST(StressCases, TheSameSeedDrawsTheSame) {
    const Subject& subject = subjectNamed("planted");
    std::set<std::string> different;
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(drawCase(subject, 3, i), drawCase(subject, 3, i));
        EXPECT_NE(drawCase(subject, 3, i), drawCase(subject, 4, i));
        different.insert(flagsOf(drawCase(subject, 3, i)));
    }
    EXPECT_EQ(different.size(), 100u);
}

TEST(StressCases, ANewAxisLeavesTheOthersAsTheyWere) {
    Subject more = subjectNamed("planted");
    more.axes.push_back("light-angle");
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(drawCase(more, 3, i).number("scale"),
                  drawCase(subjectNamed("planted"), 3, i).number("scale"));
}

TEST(StressCases, HalfAreAnywhereAndHalfAtTheEdges) {
    const Subject& subject = subjectNamed("planted");
    const Axis& scale = axisNamed("scale");
    int ends = 0, beside = 0, powers = 0;
    std::vector<int> bins(scale.binNames().size());
    for (int i = 0; i < 4000; ++i) {
        const double value = drawCase(subject, 1, i).number("scale");
        const bool end = value == scale.low || value == scale.high;
        if (i % 2 == 0) ++bins[scale.bin(value)];
        EXPECT_FALSE(end && i % 2 == 0);
        ends += end;
        powers += std::exp2(std::round(std::log2(value))) == value;
        beside +=
            !end && (std::abs(value / scale.high - 1.0) < 1e-6 || std::abs(value / scale.low - 1.0) < 1e-6);
    }
    EXPECT_GT(ends, 300);
    EXPECT_GT(powers, 150);
    EXPECT_GT(beside, 50);
    for (std::size_t i = 0; i + 1 < bins.size(); ++i) EXPECT_GT(bins[i], 100) << scale.binNames()[i];
}

TEST(StressShrink, FindsTheSimplestFormOfAPlantedFault) {
    const Subject& subject = subjectNamed("planted");
    int found = 0;
    for (int i = 0; i < 4000; ++i) {
        const Case drawn = drawCase(subject, 1, i);
        if (!plantedCheck(drawn).failure) continue;
        ++found;
        asked = 0;
        const Case shrunk = shrink(subject, drawn);
        EXPECT_LE(asked, 400);
        EXPECT_TRUE(plantedCheck(shrunk).failure);
        EXPECT_EQ(shrunk.number("fov"), 45.0);
        EXPECT_EQ(shrunk.choice("shape"), "ordinary");
        EXPECT_EQ(shrunk.choice("depth-format"), "16");  // the simplest but 24
        EXPECT_EQ(shrunk.integer("map-size"), 64);
        EXPECT_LT(shrunk.number("scale"), 310.0);
        EXPECT_LT(shrunk.number("distance"), 1.2e5);
        EXPECT_LT(flagsOf(shrunk).size(), 110u) << flagsOf(shrunk);
    }
    EXPECT_GT(found, 10);
}

TEST(StressShrink, TheLinePrintedRunsTheSameCase) {
    const Subject& subject = subjectNamed("planted");
    for (int i = 0; i < 200; ++i) {
        const Case drawn = drawCase(subject, 9, i);
        EXPECT_EQ(caseFrom(wordsOf(flagsOf(drawn))), drawn);
        EXPECT_EQ(commandLine(drawn), "build/release/bin/stress " + flagsOf(drawn));
    }
    EXPECT_EQ(caseFrom({"--subject", "planted"}), simplestCase(subject));
}

TEST(StressShrink, AWrongLineIsRefused) {
    EXPECT_THROW(caseFrom({"--subject", "plantd"}), UsageError);
    EXPECT_THROW(caseFrom({"--scale", "1"}), UsageError);
    EXPECT_THROW(caseFrom({"--subject", "planted", "--scale"}), UsageError);
    EXPECT_THROW(caseFrom({"--subject", "planted", "--light-angle", "3"}), UsageError);
    EXPECT_THROW(caseFrom({"--subject", "planted", "--scale", "1e7"}), UsageError);
}

TEST(StressSweep, CountsWhatItFinds) {
    SweepRequest request{.subjects = {&subjectNamed("planted"), &subjectNamed("throwing")}};
    request.cases = 2000;
    std::vector<std::string> said;
    request.say = [&said](const std::string& line) { said.push_back(line); };
    const SweepResult result = sweep(request);
    ASSERT_EQ(result.subjects.size(), 2u);
    const SubjectResult &of = result.subjects[0], &thrown = result.subjects[1];
    EXPECT_EQ(result.cases, 2000u);
    EXPECT_EQ(thrown.failed, thrown.cases);
    EXPECT_EQ(thrown.failures.at(0).what, "an error: no such luck");
    EXPECT_GT(of.failed, 0u);
    EXPECT_GT(of.refused, 50u);
    EXPECT_EQ(of.refusals.at("needles are refused"), of.refused);
    EXPECT_EQ(of.worst.at("product").value,
              of.worst.at("product").where.number("scale") * of.worst.at("product").where.number("distance"));
    std::uint64_t inBins = 0, failedFar = 0;
    for (const BinResult& bin : of.bins.at("scale")) inBins += bin.cases;
    EXPECT_EQ(inBins, of.cases);
    const auto& far = of.bins.at("distance");
    for (std::size_t i = axisNamed("distance").bin(1e5); i < far.size(); ++i) failedFar += far[i].failed;
    EXPECT_EQ(failedFar, of.failed);
    ASSERT_FALSE(said.empty());
    EXPECT_NE(said[0].find("build/release/bin/stress --subject"), std::string::npos);
}

TEST(StressSweep, StoppedHalfWayEverySubjectHadItsShare) {
    SweepRequest request{.subjects = {&subjectNamed("planted"), &subjectNamed("throwing")}};
    request.cases = 1000;
    int cases = 0;
    request.stop = [&cases] { return ++cases == 100; };
    const SweepResult result = sweep(request);
    EXPECT_TRUE(result.interrupted);
    EXPECT_EQ(result.cases, 100u);
    EXPECT_EQ(result.subjects[0].cases, 50u);
}

TEST(StressSweep, TheReportIsJson) {
    SweepRequest request{.subjects = {&subjectNamed("planted")}};
    request.cases = 500;
    const SweepResult result = sweep(request);
    const auto json = nlohmann::json::parse(reportJson(result));
    EXPECT_EQ(json.at("cases"), 500);
    EXPECT_EQ(json.at("subjects").at(0).at("bins").at("shape").size(), axisNamed("shape").choices.size());
    EXPECT_NE(summaryOf(result).find("500 cases"), std::string::npos);
}

/// Of ten texels, w = 1: x and y are s and t.
ProjectedTriangle flatTriangle(const Triangle& triangle) {
    return {glm::dmat4(1.0), glm::dvec2(10.0), triangle, {.snap = 0.1}};
}

TEST(StressOracle, ATriangleSurelyCoversWhatIsInsideByItsMargin) {
    const Triangle corners = {glm::dvec3(0.2, 0.2, 0.5), {0.8, 0.2, 0.5}, {0.2, 0.8, 0.7}};
    const Triangle turned = {corners[0], corners[2], corners[1]};
    for (const ProjectedTriangle& t : {flatTriangle(corners), flatTriangle(turned)}) {
        EXPECT_EQ(t.covers({2.5, 2.5}), Cover::yes);
        EXPECT_EQ(t.covers({2.1, 4.0}), Cover::maybe);
        EXPECT_EQ(t.covers({1.9, 4.0}), Cover::maybe);
        EXPECT_EQ(t.covers({1.8, 4.0}), Cover::no);
        EXPECT_EQ(t.covers({6.0, 6.0}), Cover::no);
        EXPECT_NEAR(t.depth({2.0, 5.0}), 0.6, 1e-12);
        EXPECT_NEAR(t.slope().y, 0.2 / 6.0, 1e-12);
        EXPECT_EQ(t.least(), 0.5);
        EXPECT_EQ(t.most(), 0.7);
    }
}

TEST(StressOracle, ATriangleThroughTheLightCoversOnlyWhatIsBeforeIt) {
    // Perspective along z, q = z: one corner lies behind the eye.
    glm::dmat4 perspective(1.0);
    perspective[2][3] = 1.0, perspective[3][3] = 0.0;
    const Triangle corners = {glm::dvec3(1, 1, 2), {3, 1, 2}, {2, 5, -1}};
    const ProjectedTriangle t(perspective, glm::dvec2(1.0), corners, {.snap = 0.01, .nearest = 0.1});
    EXPECT_EQ(t.covers({1.0, 0.6}), Cover::yes);  // from its near edge, at t = 1/2, upwards without end
    EXPECT_EQ(t.covers({30.0, 50.0}), Cover::yes);
    EXPECT_EQ(t.covers({1.0, 0.4}), Cover::no);
    EXPECT_EQ(t.covers({-1.5, -4.0}), Cover::no) << "the mirrored image";
    EXPECT_NEAR(t.distance({1.0, 0.5}), 2.0, 1e-12);
    EXPECT_LT(t.distance({1.0, 0.6}), 2.0);
}

TEST(StressOracle, OfASliverNothingIsSureAndALineIsNotDrawn) {
    const ProjectedTriangle sliver = flatTriangle({glm::dvec3(0.1, 0.5, 0), {0.9, 0.5, 0}, {0.5, 0.501, 0}});
    EXPECT_EQ(sliver.covers({5.0, 5.005}), Cover::maybe);
    EXPECT_EQ(sliver.covers({5.0, 5.2}), Cover::no);
    EXPECT_EQ(sliver.covers({5.0, 4.8}), Cover::no);
    EXPECT_GT(sliver.slenderness(), 700.0);
    const ProjectedTriangle line = flatTriangle({glm::dvec3(0.1, 0.5, 0), {0.9, 0.5, 0}, {0.9, 0.5, 0}});
    EXPECT_EQ(line.covers({5.0, 5.0}), Cover::no);
}

}  // namespace
}  // namespace penumbra::stress
