#include "base/error.h"

#include <gtest/gtest.h>

namespace throng {
namespace {

TEST(Problem, TextNamesSourcePlaceFoundAndExpected) {
  EXPECT_EQ((Problem{"a.json", "/crowd/agents", "-3", "an integer of at least 1"}).text(),
            "a.json: /crowd/agents: found -3, expected an integer of at least 1");
  EXPECT_EQ((Problem{"", "/x", "1", "2"}).text(), "/x: found 1, expected 2");
  EXPECT_EQ((Problem{"a.json", "", "1", "2"}).text(), "a.json: found 1, expected 2");
  EXPECT_EQ((Problem{"", "", "1", "2"}).text(), "found 1, expected 2");
}

TEST(InputError, KeepsAllProblemsAndSaysThemAll) {
  const InputError error(std::vector<Problem>{{"f", "/a", "1", "2"}, {"f", "/b", "3", "4"}});
  EXPECT_EQ(error.problems().size(), 2U);
  EXPECT_STREQ(error.what(), "f: /a: found 1, expected 2\nf: /b: found 3, expected 4");
}

TEST(Check, HoldsSilently) { check(true, "fine"); }

TEST(CheckDeathTest, AbortsNamingClaimAndPosition) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(check(false, "water is wet"), "throng bug at .*error_test.cpp:[0-9]+: water is wet");
}

}  // namespace
}  // namespace throng
