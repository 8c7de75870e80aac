// Findings about blueprints speak of the blueprint: its fields and its page, not of the crowd that
// is built from it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "places/scenarios/check/check.h"
#include "tests/places/scenarios/square.h"
#include "tests/world/temporary_folder.h"

namespace throng::scenarios {
namespace {

using nlohmann::json;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CheckBlueprint : public ::testing::Test {
 protected:
  std::vector<Finding> findings_of(const json& blueprint) {
    std::vector<Finding> found =
        check_files(folder.write("square.blueprint.json", blueprint.dump()));
    for (const Finding& finding : found) {
      EXPECT_THAT(finding.text(),
                  Not(AnyOf(HasSubstr("<"), HasSubstr("/crowd"), HasSubstr("agent "),
                            HasSubstr("generator"), HasSubstr("scenario.md"), HasSubstr("line "))));
    }
    return found;
  }
  /// The pointer of the finding with these words.
  std::string where(const json& blueprint, const std::string& words) {
    for (const Finding& finding : findings_of(blueprint)) {
      if (finding.text().find(words) != std::string::npos) return finding.problem.where;
    }
    return "nowhere";
  }

  throng::testing::TemporaryFolder folder;
  json square = throng::testing::square();
};

json box(const char* id, const json& corners) {
  return {{"id", id}, {"box", corners}, {"height_m", 3}};
}

TEST_F(CheckBlueprint, IsSilentAboutASoundOne) { EXPECT_TRUE(findings_of(square).empty()); }

TEST_F(CheckBlueprint, NamesThePeopleWhoStandWrong) {
  json wall = square;
  wall["buildings"].push_back(box("x", {9, 9, 11, 16}));
  EXPECT_EQ(where(wall, "a person at [10, 15] in an obstacle, and 5 more"), "/people/lines/0");
  json room = square;
  for (const json& corners :
       {json({7, 7, 8, 17}), json({8, 7, 13, 8}), json({12, 8, 13, 17}), json({8, 16, 12, 17})}) {
    room["buildings"].push_back(box(std::to_string(room["buildings"].size()).c_str(), corners));
  }
  EXPECT_EQ(where(room, "with no way to any open exit"), "/people/lines/0");
  EXPECT_EQ(where(room, "from where no open exit can be reached"), "/inside");
  json prop = square;
  prop["props"].push_back({{"kind", "stall"}, {"position", {10, 15}}});
  EXPECT_EQ(where(prop, "a person at [10, 15] in an obstacle"), "/people/lines/0");
  json out = square;
  out["inside"] = {{"min", {-22, -22}}, {"max", {22, 22}}};
  EXPECT_EQ(where(out, "start them inside, or enlarge"), "/inside");
}

TEST_F(CheckBlueprint, NamesWhatLeadsOutAndWhatDoesNot) {
  json gap = square;
  gap["buildings"][2]["footprint"] = {{20, 6}, {24, 6}, {24, 20}, {20, 20}};
  EXPECT_EQ(where(gap, "close it with a building"), "/buildings");
  json closed = square;
  for (json& exit : closed["exits"]) exit["open"] = false;
  EXPECT_EQ(where(closed, "no open exit, so that nobody can leave"), "/exits");
  json stay = square;
  stay["people"] = {{"groups", {{{"doing", "wait"}, {"box", {-9, -9, 9, 9}}, {"count", 3}}}}};
  EXPECT_EQ(where(stay, "which nobody heads for"), "/exits/0");
  EXPECT_EQ(where(stay, "no exit that anybody heads for"), "/exits");
}

TEST_F(CheckBlueprint, SendsReadersOfMistakesToItsPage) {
  for (const char* pointer : {"/people/groups/0/count", "/exits/0/from", "/ground", "/name"}) {
    json wrong = square;
    wrong[json::json_pointer(pointer)] = true;
    const std::vector<Finding> found = findings_of(wrong);
    ASSERT_FALSE(found.empty()) << pointer;
    EXPECT_THAT(found[0].remedy, HasSubstr("docs/reference/blueprint.md")) << pointer;
  }
  square["crowd"] = {{"scene", "a.xml"}};
  const std::vector<Finding> found = check_files(folder.write("a.blueprint.json", square.dump()));
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0].text(), HasSubstr("unknown field \"crowd\""));
  const auto broken = check_files(folder.write("b.blueprint.json", "{\"name\": \"Yard\",}"));
  ASSERT_FALSE(broken.empty());
  EXPECT_THAT(broken[0].remedy, HasSubstr("no JSON"));
}

TEST_F(CheckBlueprint, NamesFilesThatNoJobCanName) {
  const auto file = folder.write("My hall.blueprint.json", square.dump());
  for (const auto& checked : {file, folder.path()}) {
    const std::vector<Finding> found = check_files(checked);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].severity, Severity::warning);
    EXPECT_THAT(found[0].text(), HasSubstr("such as \"my_hall\""));
  }
}

TEST_F(CheckBlueprint, NamesTheFileThatSaysIt) {
  square["exits"][0]["open"] = square["exits"][1]["open"] = false;
  folder.write("base.blueprint.json", square.dump());
  const std::string text = R"({"extends": "base.blueprint.json", "name": "fire"})";
  for (const Finding& finding : check_files(folder.write("fire.blueprint.json", text))) {
    EXPECT_THAT(finding.problem.source, HasSubstr("base.blueprint.json")) << finding.text();
  }
}

}  // namespace
}  // namespace throng::scenarios
