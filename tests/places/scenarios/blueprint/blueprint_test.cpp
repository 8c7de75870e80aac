#include "places/scenarios/blueprint/blueprint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "crowd/simulation.h"
#include "places/scenarios/blueprint/blocked.h"
#include "places/scenarios/check/check.h"
#include "places/scenarios/check/survey.h"
#include "tests/places/scenarios/square.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"

namespace throng::scenarios {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using throng::testing::square;
using throng::testing::TemporaryFolder;

class Blueprint : public ::testing::Test {
 protected:
  world::Scenario make() {
    return world::load_scenario(
        make_scenario(blueprint, "square.blueprint.json", folder.path(), "sq"), "sq");
  }
  /// How many people have left after this time.
  std::size_t gone_after(const world::Scenario& scenario, double time_s) {
    crowd::LoadOptions options;
    options.model = "weidmann";
    crowd::Simulation crowd(scenario.scene_file, scenario.behavior_file, options);
    std::vector<std::uint8_t> was_there(crowd.agent_count(), 0);
    while (crowd.time_s() < time_s) {
      crowd.step();
      for (std::size_t i = 0; i < was_there.size(); ++i) was_there[i] |= crowd.present()[i];
    }
    std::size_t gone = 0;
    for (std::size_t i = 0; i < was_there.size(); ++i) {
      if (was_there[i] != 0 && crowd.present()[i] == 0) ++gone;
    }
    return gone;
  }
  std::string faults() {
    std::string texts;
    for (const Finding& finding : check_files(folder.path() / "sq.json")) {
      texts += finding.text() + "\n";
    }
    return texts;
  }

  TemporaryFolder folder;
  json blueprint = square();
};

TEST_F(Blueprint, HasTheSameCrowdWithAndWithoutClutter) {
  auto plain = scenario_files(blueprint, "square", "sq");
  blueprint["clutter"] = {{"seed", 2}, {"density", 1}};
  auto cluttered = scenario_files(blueprint, "square", "sq");
  EXPECT_EQ(json::parse(cluttered.at("sq.json"))["clutter"]["seed"], 2);
  EXPECT_GT(make().strewn_props, 0U);
  plain.erase("sq.json");
  cluttered.erase("sq.json");
  EXPECT_EQ(plain, cluttered);
}

TEST_F(Blueprint, BecomesAScenarioWithoutFaults) {
  const world::Scenario scenario = make();
  EXPECT_EQ(faults(), "");
  const LoadedCrowd loaded = load_scenario_crowd(scenario);
  std::size_t there = 0;
  for (std::size_t i = 0; i < loaded.count(); ++i) {
    if (loaded.crowd.agents.awaited[i] == 0) ++there;
  }
  EXPECT_EQ(there, 156U);
  EXPECT_NEAR(static_cast<double>(loaded.count() - there), 30, 20) << "a Poisson process";
}

TEST_F(Blueprint, WallsOfTheCrowdAreThoseThatAreDrawn) {
  const world::Scenario scenario = make();
  const LoadedCrowd loaded = load_scenario_crowd(scenario);
  EXPECT_EQ(loaded.crowd.obstacles.polygons().size(), 7U) << "6 buildings and the fountain";
  EXPECT_TRUE(loaded.crowd.obstacles.is_solid({22, 10}, 1));
  EXPECT_TRUE(loaded.crowd.obstacles.is_solid({0, 0}, 1));
  EXPECT_FALSE(loaded.crowd.obstacles.is_solid({22, 0}, 1)) << "the exit";
}

TEST_F(Blueprint, RowsDoNotPushPropsThatTouchIntoEachOther) {
  for (const double length_m : {9.9, 10.0, 13.7, 14.0, 16.4}) {
    SCOPED_TRACE(length_m);
    blueprint["rows"] = {
        {{"kind", "barrier"}, {"from", {-8, -14}}, {"to", {-8 + length_m, -14}}, {"apart_m", 2.5}}};
    std::vector<double> xs;
    for (const world::Prop& prop : make().props) {
      if (prop.kind == world::PropKind::barrier) xs.push_back(prop.position.x());
    }
    ASSERT_GT(xs.size(), 3U);
    EXPECT_DOUBLE_EQ(xs.back(), -8 + length_m);
    for (std::size_t i = 1; i < xs.size(); ++i) EXPECT_GE(xs[i] - xs[i - 1], 2.5 - 0.006);
  }
}

TEST_F(Blueprint, GivesTheSameBytesAgain) {
  make();
  const std::string scene = read_file(folder.path() / "sq_scene.xml");
  const std::string behavior = read_file(folder.path() / "sq_behavior.xml");
  make();
  EXPECT_EQ(read_file(folder.path() / "sq_scene.xml"), scene);
  EXPECT_EQ(read_file(folder.path() / "sq_behavior.xml"), behavior);
}

TEST_F(Blueprint, WaitingPeopleFaceAsSpecified) {
  blueprint["people"] = {{"groups",
                          {{{"doing", "wait"},
                            {"box", {-15, -15, -5, -5}},
                            {"count", 60},
                            {"facing", {{"towards", {-10, 18}}, {"spread_deg", 0}}}},
                           {{"doing", "wait"},
                            {"box", {5, -15, 15, -5}},
                            {"count", 60},
                            {"facing", {{"direction_deg", 180}, {"spread_deg", 0}}}},
                           {{"doing", "wait"}, {"box", {-15, 5, -5, 15}}, {"count", 60}}}},
                         {"lines", {{{"from", {10, 15}}, {"to", {10, 10}}, {"count", 6}}}}};
  const world::Scenario scenario = make();
  crowd::LoadOptions options;
  options.model = "weidmann";
  crowd::Simulation crowd(scenario.scene_file, scenario.behavior_file, options);
  ASSERT_EQ(crowd.agent_count(), 186U);
  for (const double until_s : {0.0, 20.0}) {
    while (crowd.time_s() < until_s) crowd.step();
    double east = 0;
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      const Eigen::Vector2d at = crowd.positions()[i].cast<double>();
      const auto yaw = static_cast<double>(crowd.yaws_rad()[i]);
      const auto off = [&](double wanted) {
        return std::abs(std::remainder(yaw - wanted, 2 * EIGEN_PI));
      };
      if (i < 6) {
        EXPECT_LT(off(EIGEN_PI / 2), 0.7) << "a queue looks to its head";
      } else if (at.y() < 0 && at.x() < 0) {
        EXPECT_LT(off(std::atan2(18 - at.y(), -10 - at.x())), 0.05);
      } else if (at.y() < 0) {
        EXPECT_LT(off(EIGEN_PI), 0.05);
      } else if (off(0) < EIGEN_PI / 4) {
        ++east;
      }
    }
    EXPECT_LT(east, 30) << "of 60 who look anywhere";
  }
}

TEST_F(Blueprint, CrossingPeopleLeaveAndStrollersStay) {
  const std::size_t gone = gone_after(make(), 90);
  EXPECT_GT(gone, 5U);
  EXPECT_LT(gone, 60U);
}

class Disasters : public Blueprint, public ::testing::WithParamInterface<const char*> {};

TEST_P(Disasters, MakePeopleFlee) {
  blueprint["disasters"] = {{{"kind", GetParam()},
                             {"position", {6, 6}},
                             {"start_s", 10},
                             {"radius_m", 3},
                             {"growth_mps", 1},
                             {"max_radius_m", 15}}};
  const world::Scenario scenario = make();
  EXPECT_EQ(faults(), "");
  ASSERT_EQ(scenario.disasters.size(), 1U);
  EXPECT_THAT(scenario.disaster_agents, ::testing::ElementsAre(0));
  EXPECT_GT(gone_after(scenario, 60), 75U) << "half of them at least";
}

INSTANTIATE_TEST_SUITE_P(All, Disasters,
                         ::testing::Values("explosion", "fire", "attacker", "collapse", "gas"));

/// Last x of the people who have left after a time.
std::vector<float> last_seen_x(const world::Scenario& scenario, double from_s, double to_s) {
  crowd::LoadOptions options;
  options.model = "weidmann";
  crowd::Simulation crowd(scenario.scene_file, scenario.behavior_file, options);
  std::vector<float> x;
  while (crowd.time_s() < to_s) {
    const std::vector<std::uint8_t> before(crowd.present().begin(), crowd.present().end());
    crowd.step();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool leaves = before[i] != 0 && crowd.present()[i] == 0;
      if (leaves && crowd.time_s() > from_s) x.push_back(crowd.positions()[i].x());
    }
  }
  return x;
}

TEST_F(Blueprint, NobodyFleesThroughADoorThatADisasterHasGrownOver) {
  blueprint["people"].erase("sources");
  blueprint["disasters"] = {{{"kind", "gas"},
                             {"position", {16, 0}},
                             {"start_s", 1},
                             {"radius_m", 2},
                             {"growth_mps", 0.5},
                             {"max_radius_m", 10},
                             {"noticed_m", 3},
                             {"notice_growth_mps", 1}}};
  const world::Scenario scenario = make();
  EXPECT_TRUE(scenario.exits[0].open) << "it is free at first";
  // The cloud reaches the door after 5 s; from there one walks some 15 s until one is out of sight.
  const std::vector<float> late = last_seen_x(scenario, 35, 70);
  ASSERT_GT(late.size(), 30U);
  EXPECT_LT(*std::max_element(late.begin(), late.end()), 0);
  blueprint["disasters"][0]["blocked_m"] = 0;
  const std::vector<float> not_blocked = last_seen_x(make(), 35, 70);
  EXPECT_GT(*std::max_element(not_blocked.begin(), not_blocked.end()), 0);
}

TEST(BlockedDiscs, GrowWithTheirDisasters) {
  People people;
  Danger fire;
  fire.seen = {world::DisasterKind::fire, 0, {3, 4}, 10, 2, 0.5, 8};
  fire.blocked_m = 3;
  people.dangers = {fire};
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  ASSERT_EQ(discs.size(), 4U) << "at first, and after 2, 4 and 6 m";
  EXPECT_EQ(discs[0].obstacle_class, 2U);
  EXPECT_EQ(discs[0].radius_m, 3);
  for (std::size_t i = 1; i < discs.size(); ++i) {
    EXPECT_DOUBLE_EQ(discs[i].radius_m, 3 + 2.0 * static_cast<double>(i));
    EXPECT_DOUBLE_EQ(discs[i].from_s, 10 + 4.0 * static_cast<double>(i));
    EXPECT_EQ(discs[i].obstacle_class & (discs[i].obstacle_class - 1), 0U) << "one bit";
  }
  people.dangers.assign(10, fire);
  std::uint32_t classes = 0;
  for (const BlockedDisc& disc : blocked_discs(people)) {
    if (disc.obstacle_class == 2) continue;
    EXPECT_EQ(classes & disc.obstacle_class, 0U);
    classes |= disc.obstacle_class;
  }
  EXPECT_NE(classes, 0U);
}

TEST_F(Blueprint, CaughtPeopleLieAndStay) {
  const auto hurt_after = [&](const char* kind, double time_s) {
    blueprint["disasters"] = {
        {{"kind", kind}, {"position", {6, 6}}, {"start_s", 2}, {"radius_m", 4}}};
    const world::Scenario scenario = make();
    crowd::LoadOptions options;
    options.model = "weidmann";
    crowd::Simulation crowd(scenario.scene_file, scenario.behavior_file, options);
    while (crowd.time_s() < time_s) crowd.step();
    const auto& names = crowd.state_names();
    const auto found = std::find(names.begin(), names.end(), "Casualty");
    return found == names.end()
               ? std::ptrdiff_t{0}
               : std::count(crowd.states().begin(), crowd.states().end(), found - names.begin());
  };
  EXPECT_EQ(hurt_after("explosion", 1.5), 0);
  const std::ptrdiff_t hurt = hurt_after("explosion", 4);
  EXPECT_GT(hurt, 2);
  EXPECT_EQ(hurt_after("explosion", 40), hurt) << "who comes by later is not hurt";
  EXPECT_GT(hurt_after("collapse", 4), 2);
  EXPECT_EQ(hurt_after("fire", 20), 0);
}

TEST_F(Blueprint, ADisasterInADoorShutsIt) {
  blueprint["disasters"] = {{{"kind", "collapse"}, {"position", {20, 0}}, {"radius_m", 4}}};
  const world::Scenario scenario = make();
  EXPECT_FALSE(scenario.exits[0].open);
  EXPECT_TRUE(scenario.exits[1].open);
  EXPECT_EQ(scenario.exits[1].goals.size(), 2U);
  EXPECT_EQ(scenario.exits[0].goals.size(), 1U) << "nobody flees to it";
}

TEST_F(Blueprint, MayExtendAnother) {
  folder.write("square.blueprint.json", blueprint.dump());
  const auto file =
      folder.write("burning.blueprint.json",
                   R"({"extends": "square.blueprint.json", "name": "Burning", "disasters":
          [{"kind": "fire", "position": [0, 8], "start_s": 5}]})");
  blueprint = load_blueprint(file);
  const world::Scenario scenario = make();
  EXPECT_EQ(scenario.name, "Burning");
  EXPECT_EQ(scenario.exits.size(), 2U);
  EXPECT_EQ(scenario.disasters.front().start_s, 5);
}

std::vector<Problem> problems_of_blueprint(const json& blueprint) {
  try {
    build_scenario(blueprint, "mine.blueprint.json", "mine");
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

TEST_F(Blueprint, FaultsOfARowAreAtTheRowOnce) {
  const json row = {{"kind", "tree"}, {"from", {-8, -6}}, {"to", {8, -6}}, {"apart_m", 4}};
  for (const auto& [field, value] :
       {std::pair<const char*, json>{"kind", "treee"}, std::pair<const char*, json>{"scale", 100},
        std::pair<const char*, json>{"apart_m", 0}}) {
    blueprint["rows"] = {row, row};
    blueprint["rows"][1][field] = value;
    const std::vector<Problem> problems = problems_of_blueprint(blueprint);
    ASSERT_EQ(problems.size(), 1U) << field;
    EXPECT_EQ(problems[0].where, std::string("/rows/1/") + field);
    EXPECT_TRUE(blueprint.contains(json::json_pointer(problems[0].where)));
  }
}

TEST_F(Blueprint, FaultsOfPropsOfARowAreAtTheRow) {
  blueprint["rows"] = {{{"kind", "bin"}, {"from", {0, 21}}, {"to", {6, 21}}, {"apart_m", 2}}};
  const std::vector<Problem> problems = problems_of_blueprint(blueprint);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/rows/0");
  EXPECT_THAT(problems[0].found, HasSubstr("building \"north\""));
}

TEST_F(Blueprint, FaultsOfABoxAreAtTheBox) {
  blueprint["buildings"].push_back({{"id", "flat"}, {"box", {1, 1, 2}}, {"height_m", 3}});
  EXPECT_EQ(problems_of_blueprint(blueprint).at(0).where, "/buildings/6/box");
  blueprint["buildings"].back().erase("box");
  EXPECT_EQ(
      problems_of_blueprint(blueprint).at(0).text(),
      "mine.blueprint.json: /buildings/6/footprint: found nothing, expected an array of at least "
      "3, or \"box\": [x0, y0, x1, y1]");
}

TEST_F(Blueprint, FaultsAreOfTheFileThatHoldsThem) {
  json base = blueprint;
  base["exits"] = json::array();
  const auto base_file = folder.write("base.blueprint.json", base.dump());
  const auto file =
      folder.write("more.blueprint.json", R"({"extends": "base.blueprint.json", "name": "More"})");
  try {
    make_scenario(file, folder.path(), "more");
    ADD_FAILURE() << "nothing was refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().at(0).text(),
              base_file.string() + ": /exits: found [], expected a list of at least one exit");
  }
}

struct Mistake {
  const char* name;
  const char* pointer;
  json value;
  const char* where;
  const char* words;
};

class BlueprintMistake : public Blueprint, public ::testing::WithParamInterface<Mistake> {};

TEST_P(BlueprintMistake, IsNamed) {
  blueprint[json::json_pointer(GetParam().pointer)] = GetParam().value;
  try {
    make();
    FAIL() << "nothing was refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().front().where, GetParam().where);
    EXPECT_EQ(error.problems().front().source, "square.blueprint.json");
    EXPECT_THAT(error.what(), HasSubstr(GetParam().words));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BlueprintMistake,
    ::testing::Values(Mistake{"too_many", "/people/groups/0/count", 20000, "/people/groups/0/count",
                              "at most"},
                      Mistake{"no_such_doing", "/people/groups/0/doing", "fly",
                              "/people/groups/0/doing", "\"stroll\", \"wait\""},
                      Mistake{"strollers_face_the_way", "/people/groups/0/facing", "random",
                              "/people/groups/0/facing", "wait"},
                      Mistake{"no_such_facing", "/people/lines/0/facing", "up",
                              "/people/lines/0/facing", "towards"},
                      Mistake{"two_facings", "/people/lines/0/facing",
                              json::parse(R"({"towards": [1, 2], "direction_deg": 3})"),
                              "/people/lines/0/facing", "one of them"},
                      Mistake{"no_such_exit", "/people/sources/0/exit", "up",
                              "/people/sources/0/exit", "east, west"},
                      Mistake{"nobody", "/people", json::object(), "/people", "nobody"},
                      Mistake{"two_times", "/people/sources/0/table", json::parse("[[1, 2]]"),
                              "/people/sources/0", "one of them"},
                      Mistake{"menge_files", "/crowd", json::object(), "/crowd", "unknown"},
                      Mistake{"slow_explosion", "/disasters",
                              json::parse(R"([{"kind": "explosion", "position": [0, 0],
                                               "hurts_after_s": 3}])"),
                              "/disasters/0/hurts_after_s", "hurt at once"},
                      Mistake{"no_such_disaster", "/disasters",
                              json::parse(R"([{"kind": "rain", "position": [0, 0]}])"),
                              "/disasters/0/kind", "fire"}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace throng::scenarios
