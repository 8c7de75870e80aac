// The one JSON parser: what it takes, and its limits.
#include "base/json_text.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace throng {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

std::string nested_arrays(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

Problem problem_of(const std::string& text, const JsonLimits& limits = {}) {
  try {
    static_cast<void>(parse_json(text, "file", limits));
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U);
    EXPECT_TRUE(parse_json_or_discard(text, limits).is_discarded());
    return error.problems().front();
  }
  ADD_FAILURE() << "taken: " << text.substr(0, 100);
  return {};
}

TEST(JsonText, ReadsWhatTheLibraryReads) {
  for (const std::string text :
       {"null", "true", "-0", "12", "-12", "1.5e-3", "\"a\\u00e4\\ud83d\\ude00\"", "[]", "{}",
        R"([1,[2,{"a":[]}],{"b":{"c":null,"d":"x"}},[],"e"])", "18446744073709551615",
        "-9223372036854775808", "123456789012345678901234567890", " { \"a\" : [ 1 , 2 ] } "}) {
    EXPECT_EQ(parse_json(text, ""), json::parse(text)) << text;
    EXPECT_EQ(parse_own_json(text, "x"), json::parse(text)) << text;
    EXPECT_EQ(parse_json_or_discard(text), json::parse(text)) << text;
  }
}

TEST(JsonText, DepthIsLimitedBeforeAnythingIsBuilt) {
  EXPECT_EQ(parse_json(nested_arrays(64), "").size(), 1U);
  EXPECT_THAT(problem_of(nested_arrays(65)).found, HasSubstr("more than 64"));
  EXPECT_THAT(problem_of(std::string(50'000'000, '[')).found, HasSubstr("more than 64"));
  EXPECT_THAT(problem_of(repeated("{\"a\":", 30'000'000)).found, HasSubstr("more than 64"));
  EXPECT_THAT(problem_of(repeated("[{\"a\":", 33)).where, HasSubstr("/0/a/0/a"));
  // Depth counts what is open, not what has been.
  EXPECT_EQ(parse_json("[" + repeated("[[]],", 1000) + "[]]", "").size(), 1001U);
}

TEST(JsonText, SizesAreLimited) {
  const JsonLimits small = {.max_depth = 4,
                            .max_bytes = 100,
                            .max_values = 10,
                            .max_object_keys = 3,
                            .max_key_bytes = 5,
                            .max_number_chars = 30};
  EXPECT_THAT(problem_of(std::string(101, ' '), small).found, HasSubstr("101 bytes"));
  EXPECT_NO_THROW(static_cast<void>(parse_json("[1,2,3,4,5,6,7,8,9]", "", small)));
  EXPECT_THAT(problem_of("[1,2,3,4,5,6,7,8,9,0]", small).found, HasSubstr("10 values"));
  EXPECT_THAT(problem_of("[[],[],[],[],[],[],[],[],[],[]]", small).found, HasSubstr("10 values"));
  EXPECT_THAT(problem_of(R"({"a":1,"b":1,"c":1,"d":1})", small).found, HasSubstr("3 keys"));
  EXPECT_THAT(problem_of(R"({"a":{"123456":1}})", small).found, HasSubstr("a key of 6 bytes"));
  EXPECT_EQ(problem_of(R"({"a":{"123456":1}})", small).where, "/a");
  EXPECT_THAT(problem_of(std::string(31, '9'), small).found, HasSubstr("31 characters"));
}

TEST(JsonText, NumbersFitADouble) {
  for (const char* text : {"1e999", "-1e999", "[1e400]"}) {
    EXPECT_THAT(problem_of(text).found, HasSubstr("number overflow")) << text;
  }
  EXPECT_THAT(problem_of("1" + std::string(1'000'000, '0')).found, HasSubstr("number"));
  EXPECT_LE(problem_of("1" + std::string(1'000'000, '0')).found.size(), 400U);
  EXPECT_THAT(problem_of("0." + std::string(1'000'000, '1')).found, HasSubstr("number"));
  for (const char* text : {"NaN", "Infinity", "-Infinity", "nan", "01", "+1", ".5", "1.", "0x1"}) {
    EXPECT_THAT(problem_of(text).found, HasSubstr("syntax error")) << text;
  }
}

TEST(JsonText, RefusesWhatIsNoJson) {
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[1,]"), std::string("{\"a\":1,}"),
        std::string("[1] 2"), std::string("'a'"), std::string("/* */ 1"), std::string("\"\xff\""),
        std::string("\"\xc0\x80\""), std::string("\"\xed\xa0\x80\""), std::string("\"\\ud800\""),
        std::string("\"\\udc00\\ud800\""), std::string("\"a\nb\""), std::string("[1\0]", 4)}) {
    EXPECT_EQ(problem_of(text).expected, "valid JSON") << text;
  }
  EXPECT_EQ(problem_of("{\n  \"a\": x}").where, "line 2, column 8");
  EXPECT_THAT(problem_of(R"({"b": {"a": 1, "\u0061": 2}})").found, HasSubstr("\"a\" twice"));
}

TEST(JsonText, OwnTextMayNotBeDeep) {
  EXPECT_THROW(static_cast<void>(parse_own_json(nested_arrays(65), "the job")), EnvironmentError);
  try {
    static_cast<void>(parse_own_json("{", "the job"));
    ADD_FAILURE();
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the job is damaged: line 1, column 2"));
  }
}

TEST(JsonText, ListsAreHandedOverPiecemeal) {
  std::vector<json> seen;
  const json rest = parse_own_json_list(
      R"({"a": [{"files": 1}], "files": [{"x": [{"y": 1}]}, [2, [3]]], "z": {"files": [{}]}})", "m",
      "files", [&](const json& element) { seen.push_back(element); });
  EXPECT_EQ(rest, json::parse(R"({"a": [{"files": 1}], "files": [], "z": {"files": [{}]}})"));
  EXPECT_EQ(json(seen), json::parse(R"([{"x": [{"y": 1}]}, [2, [3]]])"));
}

}  // namespace
}  // namespace throng
