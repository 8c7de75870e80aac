#include "base/json/field_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>

namespace throng::fields {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

struct Lamp {
  std::string kind = "street";
  double height_m = 4;
  std::optional<double> watt;
  int count = 1;
  bool on = true;
  std::vector<int> list;
  std::string name;
};

FieldTable<Lamp> lamp_fields() {
  FieldTable<Lamp> table;
  table.add("kind", "Kind", "", one_of_words(std::array{"street", "house"}), at(&Lamp::kind),
            "Kind.");
  table.group("size", "Size", "");
  table.add("size/height_m", "Height", "m", numbers(1, 12), at(&Lamp::height_m), "Height.");
  table.add("watt", "Power", "W", raw({{"type", "number"}, {"exclusiveMinimum", 0}}),
            at(&Lamp::watt), "");
  table.add("count", "Count", "", integers(1, 9), at(&Lamp::count), "").renamed_from("number");
  table.add("on", "On", "", booleans(), at(&Lamp::on), "");
  table.add("list", "List", "", raw({{"type", "array"}, {"minItems", 1}, {"maxItems", 3}}),
            at(&Lamp::list), "");
  table.add("name", "Name", "", texts(1, 8), at(&Lamp::name), "").required();
  return table;
}

struct Outcome {
  Lamp lamp;
  std::vector<std::string> texts;
};

Outcome read(const char* text) {
  const std::string source = "lamp.json";
  std::vector<Problem> problems;
  Outcome outcome;
  lamp_fields().read_checked(json::parse(text), outcome.lamp, {"/lamps/0", source, problems});
  for (const Problem& problem : problems) outcome.texts.push_back(problem.text());
  return outcome;
}

TEST(FieldTable, ReadsValidValues) {
  const Outcome outcome = read(
      R"({"kind": "house", "size": {"height_m": 2}, "watt": 40, "count": 3, "on": false,
          "list": [1, 2], "name": "porch"})");
  EXPECT_THAT(outcome.texts, ElementsAre());
  EXPECT_EQ(outcome.lamp.kind, "house");
  EXPECT_EQ(outcome.lamp.height_m, 2);
  EXPECT_EQ(outcome.lamp.watt, 40);
  EXPECT_EQ(outcome.lamp.count, 3);
  EXPECT_FALSE(outcome.lamp.on);
  EXPECT_THAT(outcome.lamp.list, ElementsAre(1, 2));
}

// Lengths count characters, as in JSON Schema: each letter of this name takes two bytes.
TEST(FieldTable, CountsCharactersOfTexts) {
  EXPECT_THAT(read(R"({"name": "äöüßéèàâ"})").texts, ElementsAre());
  EXPECT_THAT(read(R"({"name": "äöüßéèàâx"})").texts,
              ElementsAre(::testing::HasSubstr("expected a text of 1 to 8 characters")));
}

TEST(FieldTable, NamesEveryMistakeAtOnceAndReadsTheRest) {
  const Outcome outcome = read(
      R"({"kind": "moon", "size": {"height_m": 12.5, "hight_m": 3}, "watt": 0, "count": 2.5,
          "on": 1, "list": [], "nmae": "x"})");
  EXPECT_THAT(
      outcome.texts,
      UnorderedElementsAre(
          R"(lamp.json: /lamps/0/kind: found "moon", expected one of "street", "house")",
          R"(lamp.json: /lamps/0/size/height_m: found 12.5, expected a number from 1 to 12)",
          R"(lamp.json: /lamps/0/size/hight_m: unknown field "hight_m"; did you mean "height_m"?)",
          R"(lamp.json: /lamps/0/watt: found 0, expected a number above 0)",
          R"(lamp.json: /lamps/0/count: found 2.5, expected an integer from 1 to 9)",
          R"(lamp.json: /lamps/0/on: found 1, expected true or false)",
          R"(lamp.json: /lamps/0/list: found [], expected an array of 1 to 3 items)",
          R"(lamp.json: /lamps/0/name: found nothing, expected a text of 1 to 8 characters )"
          "without control characters",
          R"(lamp.json: /lamps/0/nmae: unknown field "nmae"; did you mean "name"?)"));
  EXPECT_EQ(outcome.lamp.height_m, 4) << "as it was";
  EXPECT_EQ(read(R"({"kind": "house", "count": 10, "name": "a"})").lamp.kind, "house");
}

TEST(FieldTable, WordsOfAnotherTypeAreNoWords) {
  EXPECT_THAT(
      read(R"({"kind": 1, "name": "a"})").texts,
      ElementsAre(R"(lamp.json: /lamps/0/kind: found 1, expected one of "street", "house")"));
  EXPECT_THAT(read(R"({"size": 1, "name": "a"})").texts,
              ElementsAre("lamp.json: /lamps/0/size: found 1, expected an object"));
  EXPECT_THAT(read("[1]").texts, ElementsAre("lamp.json: /lamps/0: found [1], expected an object"));
}

TEST(FieldTable, AnOldNameIsReadUnlessBothAreGiven) {
  const Outcome old = read(R"({"number": 4, "name": "a"})");
  EXPECT_THAT(old.texts, ElementsAre());
  EXPECT_EQ(old.lamp.count, 4);
  EXPECT_EQ(read(R"({"number": 40, "name": "a"})").texts.size(), 1U) << "its rules are the same";
  EXPECT_THAT(
      read(R"({"number": 4, "count": 5, "name": "a"})").texts,
      ElementsAre(
          R"(lamp.json: /lamps/0/number: found both "count" and "number", expected only "count")"));
}

struct Street {
  std::string id;
  std::vector<Lamp> lamps;
};

TEST(FieldTable, ReadsListsOfObjectsAndChecksNames) {
  const FieldTable<Lamp> lamps = lamp_fields();
  FieldTable<Street> table;
  table.add("id", "", "", names(4), at(&Street::id), "Id.").required();
  table.add_list("lamps", lamps, at(&Street::lamps), "Lamps.", 1)
      .checked([](const Street& street, const json& /*list*/, const FieldLocation& place) {
        if (street.lamps[0].count > 2) place.below(0).reject("many", "few");
      });
  const auto problems_in = [&](const char* text, Street& street) {
    const std::string source = "street.json";
    std::vector<Problem> problems;
    table.read_checked(json::parse(text), street, {"", source, problems});
    std::vector<std::string> texts;
    for (const Problem& problem : problems) texts.push_back(problem.text());
    return texts;
  };
  Street street;
  EXPECT_THAT(problems_in(R"({"id": "a-_9", "lamps": [{"name": "x"}, {"name": "y"}]})", street),
              ElementsAre());
  ASSERT_EQ(street.lamps.size(), 2U);
  EXPECT_EQ(street.lamps[1].name, "y");
  EXPECT_THAT(
      problems_in(R"({"id": "a b", "lamps": [{"count": 3, "name": "x"}, {"on": 1}]})", street),
      UnorderedElementsAre(
          R"(street.json: /id: found "a b", expected a name of letters, digits, '_' and '-', of at )"
          "most 4 characters",
          "street.json: /lamps/1/on: found 1, expected true or false",
          ::testing::HasSubstr("/lamps/1/name: found nothing"),
          "street.json: /lamps/0: found many, expected few"));
  EXPECT_THAT(problems_in(R"({"id": "abcde", "lamps": []})", street),
              ElementsAre(::testing::HasSubstr("/id"),
                          "street.json: /lamps: found [], expected an array of at least 1"));
}

TEST(FieldTable, PrintsTheValuesThatItReads) {
  const Outcome outcome = read(R"({"size": {"height_m": 2}, "name": "a"})");
  EXPECT_EQ(lamp_fields().print(outcome.lamp),
            json::parse(R"({"kind": "street", "size": {"height_m": 2.0}, "count": 1, "on": true,
                            "list": [], "name": "a"})"));
}

}  // namespace
}  // namespace throng::fields
