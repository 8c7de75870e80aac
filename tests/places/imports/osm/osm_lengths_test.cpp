// Lengths and counts of tags, by the pages Key:height and Map_Features/Units of
// wiki.openstreetmap.org: a foot has 0.3048 m, an inch 0.0254 m.
#include "places/imports/osm/osm_lengths.h"

#include <gtest/gtest.h>

#include <utility>

namespace throng::imports {
namespace {

TEST(Lengths, AreReadInTheSpellingsOfTheWiki) {
  for (const auto& [text, meters] :
       {std::pair("0", 0.0), std::pair("7.25", 7.25), std::pair("7 m", 7.0),
        std::pair("0.2 km", 200.0), std::pair("3 ft", 0.9144), std::pair("3'", 0.9144),
        std::pair("5'11\"", 1.8034), std::pair("0'6\"", 0.1524), std::pair("6\"", 0.1524),
        std::pair("0.01 mi", 16.09344), std::pair("1000", 1000.0)}) {
    const auto length = length_in(text);
    ASSERT_TRUE(length) << text;
    EXPECT_NEAR(*length, meters, 1e-9) << text;
  }
}

TEST(Lengths, AreReadInCommonWrongSpellings) {
  for (const auto& [text, meters] : {std::pair("7,25", 7.25),
                                     std::pair("7m", 7.0),
                                     std::pair("7,5 m", 7.5),
                                     std::pair("7 M", 7.0),
                                     std::pair("7 meters", 7.0),
                                     std::pair("7 Metres", 7.0),
                                     std::pair(" 7  m ", 7.0),
                                     std::pair("7.", 7.0),
                                     std::pair("7 m.", 7.0),
                                     std::pair("~7", 7.0),
                                     std::pair("ca. 7 m", 7.0),
                                     std::pair("about 7", 7.0),
                                     std::pair("7\u00a0m", 7.0),
                                     std::pair("250 cm", 2.5),
                                     std::pair("5 feet", 1.524),
                                     std::pair("5' 11\"", 1.8034),
                                     std::pair("5'11", 1.8034),
                                     std::pair("5'-11\"", 1.8034),
                                     std::pair("5 ft 11 in", 1.8034),
                                     std::pair("5ft11in", 1.8034),
                                     std::pair("5\u203211\u2033", 1.8034),
                                     std::pair("5\u201911\u201d", 1.8034),
                                     std::pair("5'11''", 1.8034)}) {
    const auto length = length_in(text);
    ASSERT_TRUE(length) << text;
    EXPECT_NEAR(*length, meters, 1e-9) << text;
  }
}

TEST(Lengths, AreTheLargestOfSeveral) {
  EXPECT_EQ(length_in("8;12"), 12);
  EXPECT_EQ(length_in("12 m; 8 m;"), 12);
  EXPECT_EQ(length_in("8-12 m"), 12);
  EXPECT_EQ(length_in("8 m - 12 m"), 12);
  EXPECT_EQ(length_in("8\u201312"), 12);
  EXPECT_FALSE(length_in("12-8"));
  EXPECT_FALSE(length_in("12;tall"));
}

TEST(Lengths, AreNotReadFromOtherText) {
  for (const char* text :
       {"",    " ",     ";",     "high",   "-3",    "-0.1",     "1000.1", "1e9",
        "nan", "inf",   "5 km",  "5'12\"", "5'x\"", "5'\"",     "5..6",   "5,",
        ",5",  "5 , 5", "1,200", ">5",     "5+",    "5 m high", "0x10",   "5 6"}) {
    EXPECT_FALSE(length_in(text)) << text;
  }
}

TEST(Counts, AreLevelsAndLanes) {
  for (const auto& [text, count] :
       {std::pair("0", 0.0), std::pair("3", 3.0), std::pair("2.5", 2.5), std::pair("2,5", 2.5),
        std::pair("2;3", 3.0), std::pair("3;2", 3.0), std::pair("1-3", 3.0),
        std::pair("3 levels", 3.0), std::pair("~3", 3.0), std::pair("300", 300.0)}) {
    const auto number = count_in(text);
    ASSERT_TRUE(number) << text;
    EXPECT_NEAR(*number, count, 1e-9) << text;
  }
  for (const char* text : {"", "three", "-1", "301", "3 m", "3'", "3+1", "II"}) {
    EXPECT_FALSE(count_in(text)) << text;
  }
}

}  // namespace
}  // namespace throng::imports
