#include "common/app/parameters.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra {
namespace {

struct Declared {
    int width = 3;
    float bias = 0.1f;
    bool front = false;
    std::string method = "slope";
    Parameters parameters;
    Declared() {
        parameters.add("kernel-width", width, 1, 64, "texels", "how wide");
        parameters.add("bias", bias, 0.1f, 8.0f, "texels", "how much");
        parameters.add("front-faces", front, "which faces");
        parameters.add("method", method, {"none", "slope", "normal-offset"}, "which bias");
    }
    /// The message of the UsageError, or "" if the value was taken.
    std::string refusal(const std::string& name, const std::string& text) {
        try {
            parameters.set(name, text);
            return "";
        } catch (const UsageError& error) {
            EXPECT_EQ(error.status(), exitUsage);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
    }
};

TEST(Parameters, ValuesReachTheChaptersOwnVariables) {
    Declared d;
    d.parameters.set("kernel-width", "64");
    d.parameters.set("bias", "2.5e0");
    d.parameters.set("front-faces", "on");
    d.parameters.set("method", "none");
    EXPECT_EQ(d.width, 64);
    EXPECT_EQ(d.bias, 2.5f);
    EXPECT_TRUE(d.front);
    EXPECT_EQ(d.method, "none");
    d.parameters.set("front-faces", "off");
    EXPECT_FALSE(d.front);
}

TEST(Parameters, BothEndsOfARangeAreAllowedAsTheyAreWritten) {
    Declared d;
    EXPECT_EQ(d.refusal("bias", "0.1"), "");  // 0.1f is more than 0.1
    EXPECT_EQ(d.refusal("bias", "8"), "");
    EXPECT_EQ(d.refusal("kernel-width", "1"), "");
    EXPECT_EQ(d.refusal("kernel-width", "+64"), "");
}

TEST(Parameters, WhatIsNotAllowedIsRefusedWithTheRange) {
    Declared d;
    EXPECT_EQ(d.refusal("kernel-width", "65"),
              "--kernel-width 65: must be a whole number from 1 to 64 texels");
    for (const char* bad :
         {"0", "-3", "3.5", "1e1", "abc", "", " 3", "3 ", "0x3", "99999999999999999999", "nan", "+-3"})
        EXPECT_NE(d.refusal("kernel-width", bad), "") << '"' << bad << '"';
    EXPECT_EQ(d.refusal("bias", "nan"), "--bias nan: must be a number from 0.1 to 8 texels");
    for (const char* bad :
         {"inf", "-inf", "-nan", "8.001", "0.099", "1e999", "", "1,5", "2x", "NaN", "infinity"})
        EXPECT_NE(d.refusal("bias", bad), "") << '"' << bad << '"';
    EXPECT_EQ(d.refusal("front-faces", "maybe"), "--front-faces maybe: must be on or off");
    EXPECT_EQ(d.width, 3);
    EXPECT_EQ(d.bias, 0.1f);
    int offset = 0;
    d.parameters.add("offset", offset, -5, 5, "", "either way");
    EXPECT_EQ(d.refusal("offset", "-3"), "");
    EXPECT_NE(d.refusal("offset", "+-2"), "");
    EXPECT_EQ(offset, -3);
}

TEST(Parameters, AMisspeltNameOrChoiceGetsTheNearestOne) {
    Declared d;
    EXPECT_EQ(d.refusal("method", "slop"),
              "--method slop: must be one of none, slope, normal-offset; did you mean slope?");
    EXPECT_EQ(d.refusal("kernel-widht", "3"),
              "--kernel-widht: unknown parameter; did you mean kernel-width?");
    EXPECT_EQ(d.refusal("zebra", "3"), "--zebra: unknown parameter");
    EXPECT_EQ(d.refusal("kernel", "3"), "--kernel: unknown parameter; did you mean kernel-width?");
    EXPECT_EQ(nearestName("courtyrad", {"contact", "courtyard", "room"}), "courtyard");
    EXPECT_EQ(nearestName("heck", {"contact", "heckbert_herf"}), "heckbert_herf");
    EXPECT_EQ(nearestName("xyz", {"contact", "courtyard", "room"}), "");
    EXPECT_EQ(nearestName("rxxm", {"room"}), "") << "half of it is other letters";
    EXPECT_EQ(nearestName("rm", {"room"}), "") << "half of it is missing";
    EXPECT_EQ(nearestName("bat", {"cat", "hat"}), "cat") << "of equals the first";
}

TEST(Parameters, TheListSaysEverythingAndTheValuesAreCurrent) {
    Declared d;
    d.parameters.set("kernel-width", "7");
    const auto list = nlohmann::json::parse(d.parameters.toJson(false));
    ASSERT_EQ(list.size(), 4u);
    EXPECT_EQ(list[0]["name"], "kernel-width");
    EXPECT_EQ(list[0]["type"], "int");
    EXPECT_EQ(list[0]["unit"], "texels");
    EXPECT_EQ(list[0]["range"], nlohmann::json::parse("[1, 64]"));
    EXPECT_EQ(list[0]["default"], 3);
    EXPECT_EQ(list[0]["help"], "how wide");
    EXPECT_EQ(list[1]["range"], nlohmann::json::parse("[0.1, 8.0]"));
    EXPECT_EQ(list[1]["default"], 0.1);
    EXPECT_EQ(list[3]["choices"], nlohmann::json::parse(R"(["none", "slope", "normal-offset"])"));
    const auto values = nlohmann::json::parse(d.parameters.toJson(true));
    EXPECT_EQ(values, nlohmann::json::parse(
                          R"({"kernel-width": 7, "bias": 0.1, "front-faces": false, "method": "slope"})"));
}

TEST(Parameters, OneThatMayBeAFileTakesAPathAndStillKnowsItsNames) {
    Declared d;
    std::string sky = "uniform";
    d.parameters.addOrFile("sky", sky, {"uniform", "overcast"}, "what shines");
    d.parameters.set("sky", "maps/day.exr");
    EXPECT_EQ(sky, "maps/day.exr");
    d.parameters.set("sky", "overcast");
    EXPECT_EQ(sky, "overcast");
    EXPECT_EQ(d.refusal("sky", "overcst"),
              "--sky overcst: must be one of uniform, overcast, or a file; did you mean overcast?");
    EXPECT_NE(d.refusal("sky", ""), "");
    EXPECT_NE(d.refusal("method", "a/b.c"), "") << "only where a file is asked for";
    EXPECT_EQ(nlohmann::json::parse(d.parameters.toJson(false))[4]["or_file"], true);
}

TEST(Parameters, ADeclarationThatContradictsItselfIsFoundAtOnce) {
    Declared d;
    int outside = 9;
    std::string unknown = "cubic";
    EXPECT_THROW(d.parameters.add("taps", outside, 1, 8, "", ""), Error);
    EXPECT_THROW(d.parameters.add("filter", unknown, {"box", "disk"}, ""), Error);
    EXPECT_THROW(d.parameters.add("bias", outside, 1, 10, "", ""), Error);
}

}  // namespace
}  // namespace penumbra
