#include "base/text/suggest.h"

#include <gtest/gtest.h>

#include <array>

namespace throng {
namespace {

constexpr std::array<std::string_view, 3> kFields = {"drones", "seed", "capture"};

TEST(EditDistance, IsThatOfTheLiterature) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);  // Levenshtein's usual example
  EXPECT_EQ(edit_distance("ca", "abc"), 3U) << "optimal string alignment; 2 without it";
  EXPECT_EQ(edit_distance("hips", "hpis"), 1U) << "neighbors swapped";
  EXPECT_EQ(edit_distance("", "four"), 4U);
  EXPECT_EQ(edit_distance("four", ""), 4U);
  EXPECT_EQ(edit_distance("LeftArm", "leftarm"), 0U);
  EXPECT_EQ(edit_distance(std::string(500, 'a'), std::string(499, 'a')), 1U);
}

TEST(UnknownName, NamesTheNearestKnownOne) {
  const Problem problem = unknown_name("my.job.json", "/drone", "field", "drone", kFields);
  EXPECT_EQ(problem.text(),
            "my.job.json: /drone: unknown field \"drone\"; did you mean \"drones\"?");
  EXPECT_EQ(problem.expected, "\"drones\"");
}

TEST(UnknownName, FindsSwappedAndUpperCaseLetters) {
  EXPECT_EQ(unknown_name("", "", "field", "sede", kFields).text(),
            "unknown field \"sede\"; did you mean \"seed\"?");
  EXPECT_EQ(unknown_name("", "", "field", "SEED", kFields).text(),
            "unknown field \"SEED\"; did you mean \"seed\"?");
}

TEST(UnknownName, NamesOneThatGoesOnBehindTheWord) {
  constexpr std::array<std::string_view, 4> kFormats = {"yolo-detect", "yolo-pose", "yolos",
                                                        "coco"};
  EXPECT_EQ(unknown_name("", "", "format", "yolo", kFormats).expected, "\"yolos\"")
      << "a letter too many is nearer";
  EXPECT_EQ(closest("yolo", std::span(kFormats).first(2)), "yolo-detect");
  EXPECT_EQ(closest("YOLO", std::span(kFormats).first(2)), "yolo-detect");
  EXPECT_EQ(closest("yo", std::span(kFormats).first(2)), std::nullopt);
}

TEST(UnknownName, ListsAllNamesIfNoneIsNear) {
  EXPECT_EQ(unknown_name("", "/weather", "field", "weather", kFields).text(),
            "/weather: unknown field \"weather\"; expected one of: drones, seed, capture");
}

TEST(ProblemText, IsTheStatementAloneWithoutAnExpectation) {
  EXPECT_EQ((Problem{"http://localhost", "", "there is no job x", ""}.text()),
            "http://localhost: there is no job x");
  EXPECT_EQ((Problem{"f.json", "/", "missing required field \"seed\"", "\"seed\""}.text()),
            "f.json: /: missing required field \"seed\"");
}

}  // namespace
}  // namespace throng
