#include "base/json/json_describe.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/text/words.h"

namespace throng {
namespace {

using nlohmann::json;

TEST(Describe, ShowsShortValues) {
  for (const char* text : {"5", "-1.5", "true", "null", "\"red\"", "[4, 2, 1, 3]", "[]", "{}",
                           "[[0, 1], [2, 3]]", "{\"kind\": \"plaza\"}"}) {
    EXPECT_EQ(describe(json::parse(text)), text);
  }
}

TEST(Describe, SaysHowLongTheRestIs) {
  EXPECT_EQ(describe(json(std::vector<int>(13, 1))), "an array of 13");
  EXPECT_EQ(describe(json(std::vector<std::string>(3, std::string(30, 'x')))), "an array of 3");
  EXPECT_EQ(describe(json{{"a", std::string(100, 'x')}}), "an object");
  EXPECT_EQ(describe(json(std::string(100, 'x'))), '"' + std::string(59, 'x') + "...");
  json deep = 1;
  for (int i = 0; i < 60; ++i) deep = json::array({deep});
  EXPECT_EQ(describe(deep), "an array of 1");
}

TEST(Words, CountsAgreeWithTheirNouns) {
  EXPECT_EQ(counted(1, "fault"), "1 fault");
  EXPECT_EQ(counted(0, "fault"), "0 faults");
  EXPECT_EQ(counted(2, "fault"), "2 faults");
  EXPECT_EQ(counted(1, "person", "people"), "1 person");
  EXPECT_EQ(counted(2, "person", "people"), "2 people");
}

}  // namespace
}  // namespace throng
