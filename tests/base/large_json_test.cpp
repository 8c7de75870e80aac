// Texts of millions of values: a minute with sanitizers, so this program runs with the release
// build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/json/json_text.h"

namespace throng {
namespace {

TEST(LargeJson, OwnTextMayBeLarge) {
  std::string many = "[";
  for (int i = 0; i < 5'000'000; ++i) many += "1,";
  many += "0]";
  try {
    static_cast<void>(parse_json(many, "file"));
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1U);
    EXPECT_THAT(error.problems().front().found, testing::HasSubstr("5000000 values"));
  }
  EXPECT_EQ(parse_own_json(many, "x").size(), 5'000'001U);
}

}  // namespace
}  // namespace throng
