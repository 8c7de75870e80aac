// Violations of a schema: their places and their words.
#include "base/schemas/json_schema.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace throng::schemas {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

JsonSchema example() {
  return JsonSchema(json::parse(R"({
    "type": "object", "additionalProperties": false, "required": ["name"],
    "properties": {
      "name": {"type": "string", "maxLength": 5},
      "title": {"type": "string", "x-one-line": true},
      "titles": {"type": "array", "items": {"type": "string", "x-one-line": true}},
      "weather": {"type": "string", "enum": ["clear", "overcast", "rain"]},
      "points": {"type": "array", "items": {"$ref": "#/definitions/point"}},
      "speed": {"x-expected": "a number or a distribution",
                "anyOf": [{"type": "number", "minimum": 0},
                          {"type": "object", "additionalProperties": false, "required": ["normal"],
                           "properties": {"normal": {"$ref": "#/definitions/point"}}}]},
      "frames": {"type": "object", "additionalProperties": {"$ref": "#/definitions/frame"}}
    },
    "definitions": {
      "point": {"type": "array", "items": {"type": "number", "maximum": 9}, "minItems": 2,
                "maxItems": 2, "x-expected": "[x, y]"},
      "frame": {"type": "object", "additionalProperties": false, "properties": {"mass": {"type": "number"}}}
    }})"));
}

std::vector<std::string> violations(const char* text) {
  static const JsonSchema schema = example();
  std::vector<std::string> texts;
  for (const Problem& problem : schema.problems(json::parse(text), "file.json")) {
    texts.push_back(problem.where + ": " + problem.found + " / " + problem.expected);
  }
  return texts;
}

TEST(JsonSchema, AValidDocumentHasNoProblem) {
  EXPECT_THAT(violations(R"({"name": "a", "points": [[1, 2]], "speed": {"normal": [1, 2]},
                             "frames": {"x": {"mass": 1}}})"),
              ElementsAre());
}

TEST(JsonSchema, NamesThePlaceAndTheExpectation) {
  EXPECT_THAT(violations(R"({"name": 7})"), ElementsAre(HasSubstr("/name: 7 / a text")));
  EXPECT_THAT(violations(R"({"name": "a", "points": [[1, 2], [1]]})"),
              ElementsAre("/points/1: [1] / [x, y]"));
  EXPECT_THAT(violations(R"({"name": "a", "points": [[1, "b"]]})"),
              ElementsAre(HasSubstr("/points/0/1: \"b\" / a number")));
  EXPECT_THAT(violations(R"({"name": "a", "frames": {"x": {"mas": 1}}})"),
              ElementsAre(HasSubstr("/frames/x/mas: unknown field \"mas\" / \"mass\"")));
  EXPECT_THAT(violations("[1]"), ElementsAre(HasSubstr("an object")));
}

TEST(JsonSchema, TextsOfOneLineHaveNoControlCharacters) {
  for (const char* text : {"a\\nb", "\\u001b[2J", "\\u0000", "del\x7f", "c1\xc2\x9b"}) {
    EXPECT_THAT(violations(fmt::format(R"({{"name": "a", "title": "{}"}})", text).c_str()),
                ElementsAre(AllOf(::testing::StartsWith("/title: "),
                                  HasSubstr("a text without control characters"))))
        << text;
  }
  EXPECT_THAT(violations(R"({"name": "a", "titles": ["b", "c\td"]})"),
              ElementsAre(::testing::StartsWith("/titles/1: ")));
  EXPECT_THAT(violations(R"({"name": "a\nb", "title": "Zoë’s «big» 群衆", "titles": [""]})"),
              ElementsAre());
}

TEST(JsonSchema, NamesTheWordThatAMisspelledOneIsNearestTo) {
  EXPECT_THAT(violations(R"({"name": "a", "weather": "overcats"})"),
              ElementsAre("/weather: unknown value \"overcats\" / \"overcast\""));
  EXPECT_THAT(violations(R"({"name": "a", "weather": "sunny"})"),
              ElementsAre("/weather: \"sunny\" / one of \"clear\", \"overcast\", \"rain\""));
}

TEST(JsonSchema, NamesMissingAndUnknownFields) {
  EXPECT_THAT(violations(R"({"nane": "a"})"),
              ElementsAre(HasSubstr("/nane: unknown field \"nane\" / \"name\""),
                          HasSubstr("/name: nothing")));
}

TEST(JsonSchema, NamesTheAlternatives) {
  EXPECT_THAT(violations(R"({"name": "a", "speed": "fast"})"),
              ElementsAre("/speed: \"fast\" / a number or a distribution"));
  EXPECT_THAT(violations(R"({"name": "a", "speed": {"norml": [1, 2]}})"),
              ElementsAre(HasSubstr("/speed: ")));
  EXPECT_THAT(violations(R"({"name": "a", "speed": {"normal": [1, 99]}})"),
              ElementsAre(HasSubstr("/speed/normal/1: 99")));
}

TEST(OtherScenarios, AreThoseThatNothingIsSaidOf) {
  std::vector<Problem> problems = {{"f", "/a/b", "1", "2"}};
  add_other_places(problems, {{"f", "/a/b", "x", ""},
                              {"f", "/a", "x", ""},
                              {"f", "/a/b/c", "x", ""},
                              {"f", "/ab", "x", ""},
                              {"f", "/a/c", "x", ""}});
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[1].where, "/ab");
  EXPECT_EQ(problems[2].where, "/a/c");
}

}  // namespace
}  // namespace throng::schemas
