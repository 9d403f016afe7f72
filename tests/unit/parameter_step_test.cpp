// Changing parameters from the keyboard: every value stays one that the command line would accept.
#include "common/app/parameter_step.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

class ParameterStep : public testing::Test {
 protected:
    ParameterStep() {
        parameters_.add("light", light_, 0, 3, "", "which");
        parameters_.add("map-size", mapSize_, 16, 8192, "texels", "how many");
        parameters_.add("offset", offset_, -500, 500, "", "an offset");
        parameters_.add("radius", radius_, 0.0f, 10.0f, "texels", "how wide");
        parameters_.add("bias", bias_, 1e-6f, 1.0f, "", "how much");
        parameters_.add("flag", flag_, "on or off");
        parameters_.add("method", method_, {"a", "b", "c"}, "which");
    }
    void step(std::size_t index, int direction, int times = 1) {
        for (int i = 0; i < times; ++i) stepParameter(parameters_.all()[index], direction);
    }

    int light_ = 0, mapSize_ = 1024, offset_ = 0;
    float radius_ = 1.0f, bias_ = 0.001f;
    bool flag_ = false;
    std::string method_ = "b";
    Parameters parameters_;
};

TEST_F(ParameterStep, SmallIntegersGoOneByOneAndStopAtTheEnds) {
    step(0, 1, 2);
    EXPECT_EQ(light_, 2);
    step(0, 1, 9);
    EXPECT_EQ(light_, 3);
    step(0, -1, 9);
    EXPECT_EQ(light_, 0);
}

TEST_F(ParameterStep, WidePositiveRangesDouble) {
    step(1, 1);
    EXPECT_EQ(mapSize_, 2048);
    step(1, -1, 2);
    EXPECT_EQ(mapSize_, 512);
    step(1, 1, 40);
    EXPECT_EQ(mapSize_, 8192);
    step(1, -1, 40);
    EXPECT_EQ(mapSize_, 16);
}

TEST_F(ParameterStep, WideRangesThroughZeroGoInFiftieths) {
    step(2, -1);
    EXPECT_EQ(offset_, -20);
    step(2, -1, 99);
    EXPECT_EQ(offset_, -500);
}

TEST_F(ParameterStep, FloatsStepThroughTheirRange) {
    step(3, 1);
    EXPECT_FLOAT_EQ(radius_, 1.2f);
    step(3, -1, 99);
    EXPECT_EQ(radius_, 0.0f);
    step(4, 1, 2);
    EXPECT_FLOAT_EQ(bias_, 0.002f);
    step(4, 1, 99);
    EXPECT_EQ(bias_, 1.0f);
}

TEST_F(ParameterStep, SwitchesToggleAndChoicesGoRound) {
    step(5, -1);
    EXPECT_TRUE(flag_);
    step(6, 1, 2);
    EXPECT_EQ(method_, "a");
    step(6, -1);
    EXPECT_EQ(method_, "c");
}

TEST_F(ParameterStep, ResetGoesBackToTheDeclaredValue) {
    for (std::size_t i = 0; i < parameters_.all().size(); ++i) step(i, 1);
    for (const Parameter& parameter : parameters_.all()) resetParameter(parameter);
    EXPECT_EQ(light_, 0);
    EXPECT_EQ(mapSize_, 1024);
    EXPECT_EQ(radius_, 1.0f);
    EXPECT_FALSE(flag_);
    EXPECT_EQ(method_, "b");
}

}  // namespace
}  // namespace penumbra
