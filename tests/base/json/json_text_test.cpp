// The one JSON parser: what it takes, and its limits.
#include "base/json/json_text.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json/json_integer.h"

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

Problem caught_problem(const std::string& text, const JsonLimits& limits = {}) {
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

TEST(JsonText, ReadsTheSameTextsAsTheLibrary) {
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
  EXPECT_THAT(caught_problem(nested_arrays(65)).found, HasSubstr("more than 64"));
  EXPECT_THAT(caught_problem(std::string(50'000'000, '[')).found, HasSubstr("more than 64"));
  EXPECT_THAT(caught_problem(repeated("{\"a\":", 30'000'000)).found, HasSubstr("more than 64"));
  EXPECT_THAT(caught_problem(repeated("[{\"a\":", 33)).where, HasSubstr("/0/a/0/a"));
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
  EXPECT_THAT(caught_problem(std::string(101, ' '), small).found, HasSubstr("101 bytes"));
  EXPECT_NO_THROW(static_cast<void>(parse_json("[1,2,3,4,5,6,7,8,9]", "", small)));
  EXPECT_THAT(caught_problem("[1,2,3,4,5,6,7,8,9,0]", small).found, HasSubstr("10 values"));
  EXPECT_THAT(caught_problem("[[],[],[],[],[],[],[],[],[],[]]", small).found,
              HasSubstr("10 values"));
  EXPECT_THAT(caught_problem(R"({"a":1,"b":1,"c":1,"d":1})", small).found, HasSubstr("3 keys"));
  EXPECT_THAT(caught_problem(R"({"a":{"123456":1}})", small).found, HasSubstr("a key of 6 bytes"));
  EXPECT_EQ(caught_problem(R"({"a":{"123456":1}})", small).where, "/a");
  EXPECT_THAT(caught_problem(std::string(31, '9'), small).found, HasSubstr("31 characters"));
}

TEST(JsonText, NumbersFitADouble) {
  for (const char* text : {"1e999", "-1e999", "[1e400]"}) {
    EXPECT_THAT(caught_problem(text).found, HasSubstr("the number ")) << text;
    EXPECT_THAT(caught_problem(text).expected, HasSubstr("within the range of a double")) << text;
  }
  EXPECT_THAT(caught_problem("1" + std::string(1'000'000, '0')).found, HasSubstr("number"));
  EXPECT_LE(caught_problem("1" + std::string(1'000'000, '0')).found.size(), 400U);
  EXPECT_THAT(caught_problem("0." + std::string(1'000'000, '1')).found, HasSubstr("number"));
  for (const char* text : {"NaN", "Infinity", "-Infinity", "nan", "01", "+1", ".5", "1.", "0x1"}) {
    EXPECT_EQ(caught_problem(text).found, text);
    EXPECT_THAT(caught_problem(text).expected, HasSubstr("a number")) << text;
  }
}

TEST(JsonText, ZeroHasNoSign) { EXPECT_EQ(parse_json("[-0.0]", "job.json").dump(), "[0.0]"); }

// JSON Schema, draft 6 and later: a number without a fraction is an integer.
TEST(JsonText, NumbersWithoutAFractionAreIntegers) {
  for (const char* text : {"2", "-7", "2.0", "20e-1", "0.2E1", "-7.0", "9007199254740992.0"}) {
    EXPECT_TRUE(is_integer(parse_json(text, ""))) << text;
  }
  for (const char* text : {"2.5", "1e300", "1e16", "\"2\"", "true", "null", "[2]"}) {
    EXPECT_FALSE(is_integer(parse_json(text, ""))) << text;
  }
}

TEST(JsonText, RefusesOtherTexts) {
  for (const std::string& text :
       {std::string("\"\xff\""), std::string("\"\xc0\x80\""), std::string("\"\xed\xa0\x80\""),
        std::string("\"\\ud800\""), std::string("\"\\udc00\\ud800\""), std::string("[1\0]", 4)}) {
    EXPECT_FALSE(caught_problem(text).found.empty()) << text;
    EXPECT_FALSE(caught_problem(text).expected.empty()) << text;
  }
  EXPECT_THAT(caught_problem(R"({"b": {"a": 1, "\u0061": 2}})").found, HasSubstr("\"a\" twice"));
}

struct Fault {
  std::string text;
  std::string where;
  std::string found;
  std::string expected;
};

TEST(JsonText, FaultsAreSaidInWordsWithLineAndColumn) {
  const std::vector<Fault> faults = {
      {"{\n  \"a\": 1,\n}", "line 2, column 9", "a comma too many before }", "no comma"},
      {"[1, 2,]", "line 1, column 6", "a comma too many before ]", "no comma"},
      {"[1,, 2]", "line 1, column 4", "a second comma", "one comma"},
      {"[,1]", "line 1, column 2", "a comma without a value before it", "a value"},
      {"{,}", "line 1, column 2", "a comma without a value before it", "a value"},
      {"{\"a\": ,}", "line 1, column 7", "a comma without a value before it", "a value"},
      {"{\"a\": }", "line 1, column 7", "no value after the colon", "a value"},
      {"{\n  \"a\": 1 // one\n}", "line 2, column 10", "a comment", "JSON has none"},
      {"/* */ 1", "line 1, column 1", "a comment", "JSON has none"},
      {"# job\n{}", "line 1, column 1", "a comment", "JSON has none"},
      {"{'a': 1}", "line 1, column 2", "a text in other quotes: 'a'", "double quotes"},
      {"{\"a\": 'b'}", "line 1, column 7", "a text in other quotes: 'b'", "double quotes"},
      {"{\xe2\x80\x9c"
       "a\": 1}",
       "line 1, column 2", "typographic quotes", "plain double quotes"},
      {"{a: 1}", "line 1, column 2", "a where a field's name is due", "double quotes"},
      {"{1: 1}", "line 1, column 2", "1 where a field's name is due", "double quotes"},
      {"{\"a\": b}", "line 1, column 7", "b", "texts are in double quotes"},
      {"{\"a\": True}", "line 1, column 7", "True", "true"},
      {"[FALSE]", "line 1, column 2", "FALSE", "false"},
      {"[None]", "line 1, column 2", "None", "null"},
      {"[undefined]", "line 1, column 2", "undefined", "null"},
      {"{\n\"a\": [-NaN]}", "line 2, column 7", "-NaN", "neither NaN nor Infinity"},
      {"{\"a\" 1}", "line 1, column 5", "no colon after \"a\"", "a colon"},
      {"{\"a\", \"b\"}", "line 1, column 5", "no colon after \"a\"", "a colon"},
      {"{\"a\"}", "line 1, column 5", "no colon after \"a\"", "a colon"},
      {"{\"a\" = 1}", "line 1, column 6", "=", "a colon"},
      {"{\"a\": 1\n \"b\": 2}", "line 1, column 8", "no comma between this value and the next",
       "a comma"},
      {"[1 2]", "line 1, column 3", "no comma between this value and the next", "a comma"},
      {"[\"a\": 1]", "line 1, column 5", "a : without a name", "a comma or a closing bracket"},
      {"{\"a\": \"b}\n", "line 1, column 7", "a text without its closing quote: \"b}",
       "a \" at its end"},
      {"\"a\nb\"", "line 1, column 1", "a text without its closing quote: \"a", "a \" at its end"},
      {"\"a\tb\"", "line 1, column 3", "a tab inside of a text", "\\t"},
      {"\"C:\\data\"", "line 1, column 4", "the unknown escape \\d", "\\\\ for a backslash"},
      {"{\"a\": [1, 2}", "line 1, column 12", "a } that closes the [ of line 1, column 7", "]"},
      {"]", "line 1, column 1", "a ] that closes nothing", "a value"},
      {"{\n\"a\": {\n", "line 3, column 1", "the end of the text, with the { of line 2, column 6",
       "}"},
      {"{\"a\":", "line 1, column 6", "the end of the text, with the { of line 1, column 1", "}"},
      {"{} {}", "line 1, column 4", "more text after the end of the value: {}", "nothing after it"},
      {"{}}", "line 1, column 3", "more text after the end of the value: }", "nothing after it"},
      {"{\"\xc3\xa4\": x}", "line 1, column 7", "x", "a value"},  // columns are characters
      {"[\"\\ud800\"]", "line 1, column 9", "half of a character", "in pairs"},
      {"[\xff]", "line 1, column 2", "bytes that are not UTF-8", "a value"},
      {"\"\xff\"", "line 1, column 1", "not UTF-8", "UTF-8"},
  };
  for (const Fault& fault : faults) {
    const Problem problem = caught_problem(fault.text);
    EXPECT_EQ(problem.where, fault.where) << fault.text;
    EXPECT_THAT(problem.found, HasSubstr(fault.found)) << fault.text;
    EXPECT_THAT(problem.expected, HasSubstr(fault.expected)) << fault.text;
  }
}

TEST(JsonText, FilesThatAreEmptyOrNoTextAreRecognized) {
  EXPECT_EQ(caught_problem("").text(), "file: found an empty file, expected valid JSON");
  EXPECT_EQ(caught_problem(" \r\n\t").found, "an empty file");
  EXPECT_EQ(caught_problem("\xef\xbb\xbf").found, "an empty file");
  EXPECT_EQ(caught_problem(std::string("\xff\xfe{\0}\0", 6)).found, "a file in UTF-16");
  EXPECT_EQ(caught_problem(std::string("\0{\0}", 4)).found, "a file in UTF-16");
  EXPECT_EQ(caught_problem(std::string("{\0}\0", 4)).found, "a file in UTF-16");
  EXPECT_EQ(caught_problem("PK\x03\x04").found, "a file in zip");
  EXPECT_EQ(parse_json("\xef\xbb\xbf{}", ""), json::object());  // the mark of UTF-8 is taken
  EXPECT_EQ(caught_problem("\xef\xbb\xbf[1,]").where, "line 1, column 3");
  try {
    static_cast<void>(parse_json("", ""));
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().found, "an empty body");
  }
}

TEST(JsonText, OwnTextMayNotBeDeep) {
  EXPECT_THROW(static_cast<void>(parse_own_json(nested_arrays(65), "the job")), EnvironmentError);
  try {
    static_cast<void>(parse_own_json("{", "the job"));
    ADD_FAILURE();
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the job is damaged: line 1, column 2: found the end"));
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
