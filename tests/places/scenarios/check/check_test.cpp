#include "places/scenarios/check/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/places/scenarios/yard.h"

namespace throng::scenarios {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using throng::testing::TemporaryFolder;
using throng::testing::Yard;

class CheckYard : public ::testing::Test {
 protected:
  std::vector<Finding> findings() { return check_files(yard.write(folder)); }
  /// Expects exactly one error, at this place and with these words.
  void expect_error(const std::string& where, const std::string& words) {
    std::string texts;
    int errors = 0;
    for (const Finding& finding : findings()) {
      if (finding.severity != Severity::error) continue;
      ++errors;
      texts += finding.text() + "\n";
      EXPECT_EQ(finding.problem.where, where);
      EXPECT_FALSE(finding.problem.expected.empty());
      EXPECT_FALSE(finding.remedy.empty());
      EXPECT_THAT(finding.problem.source, HasSubstr("yard.json"));
    }
    EXPECT_EQ(errors, 1) << texts;
    EXPECT_THAT(texts, HasSubstr(words));
  }

  /// Expects nothing but one warning, at this place and with these words.
  void expect_warning(const std::string& where, const std::string& words) {
    const std::vector<Finding> found = findings();
    ASSERT_EQ(found.size(), 1U) << (found.empty() ? "" : found.back().text());
    EXPECT_EQ(found[0].severity, Severity::warning);
    EXPECT_EQ(found[0].problem.where, where);
    EXPECT_THAT(found[0].problem.found, HasSubstr(words));
  }

  /// Walls from (11, -6) to (20, 6) that enclose a court behind the yard's gate, with a gap in the
  /// east as wide as the gate.
  static std::string court() {
    return Yard::box(11, 5, 20, 6) + Yard::box(11, -6, 20, -5) + Yard::box(19, 1.5, 20, 5) +
           Yard::box(19, -5, 20, -1.5);
  }

  void add_exit(const char* id, const nlohmann::json& from, const nlohmann::json& to) {
    yard.scenario["exits"].push_back(
        {{"id", id}, {"from", from}, {"to", to}, {"goals", nlohmann::json::parse("[[3, 1]]")}});
    yard.goals = R"(<GoalSet id="3"><Goal id="0" type="point" x="14" y="0"/>
                    <Goal id="1" type="point" x="5" y="6"/></GoalSet>)";
  }

  TemporaryFolder folder;
  Yard yard;
};

TEST_F(CheckYard, HasNoFaults) {
  const std::vector<Finding> found = findings();
  EXPECT_THAT(found, IsEmpty()) << (found.empty() ? "" : found.front().text());
}

TEST_F(CheckYard, SeesWallsAcrossAnExit) {
  yard.obstacles += Yard::box(10, -1.5, 10.5, 1.5);
  std::vector<Finding> found = findings();
  ASSERT_EQ(found.size(), 2U) << "and whoever is inside cannot get out";
  EXPECT_EQ(found[0].problem.where, "/exits/0");
  EXPECT_THAT(found[0].problem.found, HasSubstr("blocked"));
  EXPECT_THAT(found[1].problem.found, HasSubstr("no way to any open exit"));
}

// On so large a ground the cells of the path search are 0.8 m wide, and the free one next to people
// beside a wall is farther off than on a small one.
TEST_F(CheckYard, LetsPeopleStandBesideWallsOnLargeGround) {
  yard.scenario["ground"] = {
      {"min", {-1300, -1300}}, {"max", {1300, 1300}}, {"material", "pavers"}};
  yard.scenario["inside"] = {{"min", {-1000, -600.5}}, {"max", {1000, 600}}};
  yard.obstacles += Yard::box(-4, -5, 1, -3.3);
  const std::vector<Finding> found = findings();
  EXPECT_THAT(found, IsEmpty()) << (found.empty() ? "" : found.front().text());
}

TEST_F(CheckYard, SeesAnExitWithoutAWayToIt) {
  add_exit("far", {4, 5}, {4, 7});
  yard.obstacles += Yard::box(2, 3, 6, 3.4) + Yard::box(2, 8.6, 6, 9) +
                    Yard::box(2, 3.4, 2.3, 8.6) + Yard::box(5.7, 3.4, 6, 8.6);
  expect_error("/exits/1", "which nobody can reach");
}

TEST_F(CheckYard, LetsPeopleWalkAroundAnObstacleBehindADoor) {
  yard.obstacles += Yard::box(12, -3, 12.5, 3);
  EXPECT_THAT(findings(), IsEmpty());
}

TEST_F(CheckYard, SeesAWallDirectlyBehindADoor) {
  yard.obstacles += Yard::box(11.2, -3, 12, 3);
  const std::vector<Finding> found = findings();
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0].problem.found, HasSubstr("blocked"));
}

TEST_F(CheckYard, SeesAnExitIntoAClosedCourt) {
  yard.obstacles += court() + Yard::box(19, -1.5, 20, 1.5);
  expect_error("/exits/0", "behind which walls enclose the ground");
}

TEST_F(CheckYard, ACourtWithTwoDoorsOfTheYardIsClosed) {
  const auto wall = yard.obstacles.find(Yard::box(10, 1.5, 11, 10));
  ASSERT_NE(wall, std::string::npos);
  yard.obstacles.replace(wall, Yard::box(10, 1.5, 11, 10).size(),
                         Yard::box(10, 1.5, 11, 2.5) + Yard::box(10, 4.5, 11, 10));
  yard.obstacles += court() + Yard::box(19, -1.5, 20, 1.5);
  add_exit("other", {10, 2.5}, {10, 4.5});
  const std::vector<Finding> found = findings();
  ASSERT_GE(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].problem.where, "/exits/" + std::to_string(i));
    EXPECT_THAT(found[i].problem.found, HasSubstr("behind which walls enclose the ground"));
  }
}

TEST_F(CheckYard, ACourtWithAGapOrAnExitOfItsOwnIsNotClosed) {
  const auto expect_open = [&] {
    for (const Finding& finding : findings()) {
      EXPECT_EQ(finding.severity, Severity::warning) << finding.text();
    }
  };
  yard.obstacles += court();
  expect_open();
  add_exit("own", {19, -1.5}, {19, 1.5});
  expect_open();
}

TEST_F(CheckYard, WarnsOfAnExitAroundWhichPeopleCanWalk) {
  add_exit("middle", {5, -2}, {5, 2});
  expect_warning("/exits/1", "around which people can walk");
}

TEST_F(CheckYard, WarnsOfAnExitBeyondTheInside) {
  yard.scenario["inside"] = {{"min", {-12, -12}}, {"max", {8, 12}}};
  expect_warning("/exits/0", "exit \"gate\" 2.0 m outside of \"inside\"");
}

TEST_F(CheckYard, WarnsOfAnExitThatIsWiderThanItsOpening) {
  yard.scenario["exits"][0]["from"] = {10, -5};
  yard.scenario["exits"][0]["to"] = {10, 5};
  for (const double side : {1, -1}) {
    yard.scenario["buildings"].push_back({{"id", side > 0 ? "north" : "south"},
                                          {"footprint",
                                           {{10, side * 5.75 - 4.25},
                                            {11, side * 5.75 - 4.25},
                                            {11, side * 5.75 + 4.25},
                                            {10, side * 5.75 + 4.25}}},
                                          {"height_m", 4}});
  }
  expect_warning("/exits/0", "10 m wide, of which buildings leave 3 m free: figures count 3 m");
}

TEST_F(CheckYard, SeesAnExitThatIsTooNarrow) {
  yard.scenario["exits"][0]["from"] = {10, -0.15};
  yard.scenario["exits"][0]["to"] = {10, 0.15};
  expect_error("/exits/0", "0.3 m wide");
}

TEST_F(CheckYard, SeesThatNobodyHeadsForAnExit) {
  yard.selector = R"(<GoalSelector type="identity"/>)";
  expect_error("/exits", "no exit that anybody heads for");
}

TEST_F(CheckYard, SeesGoalsThatAreNotThere) {
  yard.scenario["exits"][0]["goals"] = nlohmann::json::parse("[[3, 0], [3, 7]]");
  expect_error("/exits/0/goals/1", "[3, 7]");
}

TEST_F(CheckYard, SeesThatThereIsNoOpenExit) {
  yard.scenario["exits"][0]["open"] = false;
  yard.obstacles.clear();
  yard.scenario["buildings"].clear();
  std::vector<Finding> found = findings();
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0].problem.found, HasSubstr("no open exit"));
}

TEST_F(CheckYard, SeesPeopleInWalls) {
  yard.generator = R"(<Generator type="explicit"><Agent p_x="0" p_y="0"/><Agent p_x="-6" p_y="6"/>
                      <Agent p_x="-6" p_y="7"/></Generator>)";
  expect_error("/crowd/scene", "agent 1 at [-6, 6] in an obstacle, and 1 more");
}

TEST_F(CheckYard, FindsWalledInPeople) {
  yard.obstacles += Yard::box(-4, -4, 4, -3.6) + Yard::box(-4, 3.6, 4, 4) +
                    Yard::box(-4, -3.6, -3.6, 3.6) + Yard::box(3.6, -3.6, 4, 3.6);
  std::vector<Finding> found = findings();
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found.back().problem.found, HasSubstr("and 15 more"));
  EXPECT_THAT(found.back().problem.found, HasSubstr("no way to any open exit"));
}

TEST_F(CheckYard, WarnsOfPeopleThatStartOutside) {
  yard.generator = R"(<Generator type="explicit"><Agent p_x="0" p_y="0"/><Agent p_x="13" p_y="6"/>
                      <Agent p_x="-16" p_y="7"/></Generator>)";
  const std::vector<Finding> found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_THAT(found[0].text(), HasSubstr("/inside: found agent 1 at [13, 6] outside of \"inside\", "
                                         "and 1 more, out of 3 people"));
}

TEST_F(CheckYard, WarnsOfGroundThatIsSmallerThanTheInside) {
  yard.scenario["ground"]["max"] = {11, 30};
  const std::vector<Finding> found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_THAT(found[0].text(), HasSubstr("/ground: found ground from [-30, -30] to [11, 30], "
                                         "smaller than \"inside\", from [-12, -12] to [12, 12]"));
}

TEST_F(CheckYard, SeesPeopleInProps) {
  yard.scenario["props"] = nlohmann::json::parse(R"([{"kind": "stall", "position": [-3, -3]}])");
  expect_error("/crowd/scene", "in the stall at [-3, -3]");
}

TEST_F(CheckYard, SeesBuildingsThatOverlap) {
  yard.scenario["buildings"].push_back(nlohmann::json::parse(
      R"({"id": "shed", "footprint": [[-5, 7], [-3, 7], [-3, 9], [-5, 9]], "height_m": 3})"));
  expect_error("/buildings/1", "\"shed\" and \"hut\" have 1 m²");
}

TEST_F(CheckYard, BuildingsMayTouch) {
  yard.scenario["buildings"].push_back(nlohmann::json::parse(
      R"({"id": "shed", "footprint": [[-4, 4], [-2, 4], [-2, 8], [-4, 8]], "height_m": 3})"));
  yard.obstacles += Yard::box(-4, 4, -2, 8);
  EXPECT_THAT(findings(), IsEmpty());
}

TEST_F(CheckYard, WarnsOfABuildingThatPeopleWalkThrough) {
  yard.scenario["buildings"].push_back(nlohmann::json::parse(
      R"({"id": "ghost", "footprint": [[3, 4], [7, 4], [7, 8], [3, 8]], "height_m": 3})"));
  const std::vector<Finding> found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_EQ(found[0].problem.where, "/buildings/1");
}

TEST_F(CheckYard, SeesADroneAgainstAWall) {
  yard.scenario["drones"][0]["start"] = {-3.7, 6, 3};
  expect_error("/drones/0/start", "against building \"hut\"");
}

TEST_F(CheckYard, SeesTwoDronesAtOnePosition) {
  yard.scenario["drones"].push_back({{"id", "d2"}, {"start", {0.5, 0, 20}}});
  expect_error("/drones/1/start", "at the same position");
}

TEST_F(CheckYard, SeesAPlaceDrawnInTheWrongUnit) {
  yard.scenario["inside"] = {{"min", {-0.012, -0.012}}, {"max", {0.012, 0.012}}};
  expect_error("/inside", "0.024 m");
}

TEST_F(CheckYard, ReportsFilesThatCannotBeLoaded) {
  yard.scenario["crowd"]["scene"] = "nowhere.xml";
  expect_error("/crowd/scene", "nowhere.xml");
}

TEST_F(CheckYard, ReportsMistakesInTheCrowdsFiles) {
  yard.generator = R"(<Generator type="cloud"/>)";
  const std::vector<Finding> found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].problem.source, HasSubstr("scene.xml"));
  EXPECT_THAT(found[0].problem.found, HasSubstr("cloud"));
}

TEST_F(CheckYard, ChecksAllOfAFolder) {
  yard.write(folder);
  yard.scenario["exits"][0]["open"] = false;
  folder.write("below/shut.json", yard.scenario.dump());
  const std::vector<Finding> found = check_files(folder.path());
  EXPECT_TRUE(any_error(found));
  for (const Finding& finding : found) {
    EXPECT_THAT(finding.problem.source, HasSubstr("shut.json"));
  }
  EXPECT_THROW(check_files(folder.path() / "nowhere"), InputError);
}

}  // namespace
}  // namespace throng::scenarios
