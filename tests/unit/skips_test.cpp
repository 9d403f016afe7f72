#include "common/app/skips.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace penumbra {
namespace {

constexpr Skip unseen{"unseen", "", "what nobody sees is not drawn"};
constexpr Skip kept{"kept-maps", "", "what has not changed is kept"};
constexpr Skip sameName{"unseen", "", "something else"};

TEST(Skips, AreOnUntilTheyAreSwitchedOff) {
    Skips skips;
    skips.declare(unseen);
    skips.declare(kept);
    skips.declare(unseen);  // a technique that two others use
    EXPECT_EQ(skips.all().size(), 2u);
    EXPECT_TRUE(skips(unseen) && skips(kept));
    skips.switchOff("kept-maps");
    EXPECT_TRUE(skips(unseen));
    EXPECT_FALSE(skips(kept));
    EXPECT_FALSE(skips.allOff());
    skips.switchAllOff();
    EXPECT_FALSE(skips(unseen));
    EXPECT_TRUE(skips.allOff());
    EXPECT_EQ(skips.off(), (std::vector<std::string>{"unseen", "kept-maps"}));
}

TEST(Skips, ThoseOfAnAuthorsMistakeAreRefused) {
    Skips skips;
    skips.declare(unseen);
    EXPECT_THROW(skips.declare(sameName), Error);
    EXPECT_THROW(skips(kept), Error) << "not declared: --no-skip could not switch it off";
}

TEST(Skips, AChapterWithoutAnySaysSo) {
    Skips none;
    EXPECT_FALSE(none.allOff()) << "the report would say that --skip-none was given";
    try {
        none.switchOff("unseen");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "--no-skip unseen: this chapter skips nothing");
    }
}

}  // namespace
}  // namespace penumbra
