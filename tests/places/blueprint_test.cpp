#include "places/blueprint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "crowd/simulation.h"
#include "places/check.h"
#include "places/survey.h"
#include "tests/world/temporary_folder.h"

namespace throng::places {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using throng::testing::TemporaryFolder;

json square() {
  return json::parse(R"({
    "name": "Square",
    "ground": {"min": [-60, -60], "max": [60, 60], "material": "pavers"},
    "inside": {"min": [-30, -30], "max": [30, 30]},
    "exits": [{"id": "east", "from": [20, -2], "to": [20, 2]},
              {"id": "west", "from": [-20, 1.5], "to": [-20, -1.5]}],
    "buildings": [
      {"id": "north", "footprint": [[-24, 20], [24, 20], [24, 24], [-24, 24]], "height_m": 8},
      {"id": "south", "footprint": [[-24, -24], [24, -24], [24, -20], [-24, -20]], "height_m": 8},
      {"id": "ne", "footprint": [[20, 2], [24, 2], [24, 20], [20, 20]], "height_m": 8},
      {"id": "se", "footprint": [[20, -20], [24, -20], [24, -2], [20, -2]], "height_m": 8},
      {"id": "nw", "footprint": [[-24, 1.5], [-20, 1.5], [-20, 20], [-24, 20]], "height_m": 8},
      {"id": "sw", "footprint": [[-24, -20], [-20, -20], [-20, -1.5], [-24, -1.5]], "height_m": 8}],
    "props": [{"kind": "fountain", "position": [0, 0]}],
    "drones": [{"id": "d1", "start": [0, 0, 25]}],
    "people": {
      "groups": [{"doing": "stroll", "area": [[-18, -18], [18, -18], [18, 18], [-18, 18]],
                  "count": 150}],
      "lines": [{"from": [10, 15], "to": [10, 10], "count": 6}],
      "sources": [{"doing": "cross", "exit": "east", "per_minute": 30, "until_s": 60}]}
  })");
}

class Blueprint : public ::testing::Test {
 protected:
  world::Scenario make() {
    return world::load_scenario(make_scenario(blueprint, "square.place.json", folder.path(), "sq"),
                                "sq");
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

TEST_F(Blueprint, BecomesAScenarioWithoutFaults) {
  const world::Scenario scenario = make();
  EXPECT_EQ(faults(), "");
  const LoadedCrowd loaded = load_crowd_of(scenario);
  std::size_t there = 0;
  for (std::size_t i = 0; i < loaded.count(); ++i) {
    if (loaded.crowd.agents.awaited[i] == 0) ++there;
  }
  EXPECT_EQ(there, 156U);
  EXPECT_NEAR(static_cast<double>(loaded.count() - there), 30, 20) << "a Poisson process";
}

TEST_F(Blueprint, WallsOfTheCrowdAreThoseThatAreDrawn) {
  const world::Scenario scenario = make();
  const LoadedCrowd loaded = load_crowd_of(scenario);
  EXPECT_EQ(loaded.crowd.obstacles.polygons().size(), 7U) << "6 buildings and the fountain";
  EXPECT_TRUE(loaded.crowd.obstacles.is_solid({22, 10}, 1));
  EXPECT_TRUE(loaded.crowd.obstacles.is_solid({0, 0}, 1));
  EXPECT_FALSE(loaded.crowd.obstacles.is_solid({22, 0}, 1)) << "the exit";
}

TEST_F(Blueprint, GivesTheSameBytesAgain) {
  make();
  const std::string scene = read_file(folder.path() / "sq_scene.xml");
  const std::string behavior = read_file(folder.path() / "sq_behavior.xml");
  make();
  EXPECT_EQ(read_file(folder.path() / "sq_scene.xml"), scene);
  EXPECT_EQ(read_file(folder.path() / "sq_behavior.xml"), behavior);
}

TEST_F(Blueprint, PeopleWhoCrossLeaveAndStrollersStay) {
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
                             {"most_m", 15}}};
  const world::Scenario scenario = make();
  EXPECT_EQ(faults(), "");
  ASSERT_EQ(scenario.disasters.size(), 1U);
  EXPECT_THAT(scenario.disaster_agents, ::testing::ElementsAre(0));
  EXPECT_GT(gone_after(scenario, 60), 75U) << "half of them at least";
}

INSTANTIATE_TEST_SUITE_P(All, Disasters,
                         ::testing::Values("explosion", "fire", "attacker", "collapse", "gas"));

TEST_F(Blueprint, ADisasterInADoorShutsIt) {
  blueprint["disasters"] = {{{"kind", "collapse"}, {"position", {20, 0}}, {"radius_m", 4}}};
  const world::Scenario scenario = make();
  EXPECT_FALSE(scenario.exits[0].open);
  EXPECT_TRUE(scenario.exits[1].open);
  EXPECT_EQ(scenario.exits[1].goals.size(), 2U);
  EXPECT_EQ(scenario.exits[0].goals.size(), 1U) << "nobody flees to it";
}

TEST_F(Blueprint, MayExtendAnother) {
  folder.write("square.place.json", blueprint.dump());
  const auto file = folder.write("burning.place.json",
                                 R"({"extends": "square.place.json", "name": "Burning", "disasters":
          [{"kind": "fire", "position": [0, 8], "start_s": 5}]})");
  blueprint = load_blueprint(file);
  const world::Scenario scenario = make();
  EXPECT_EQ(scenario.name, "Burning");
  EXPECT_EQ(scenario.exits.size(), 2U);
  EXPECT_EQ(scenario.disasters.front().start_s, 5);
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
    EXPECT_EQ(error.problems().front().source, "square.place.json");
    EXPECT_THAT(error.what(), HasSubstr(GetParam().words));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BlueprintMistake,
    ::testing::Values(Mistake{"too_many", "/people/groups/0/count", 20000, "/people/groups/0/count",
                              "at most"},
                      Mistake{"no_such_doing", "/people/groups/0/doing", "fly",
                              "/people/groups/0/doing", "stroll, wait"},
                      Mistake{"no_such_exit", "/people/sources/0/exit", "up",
                              "/people/sources/0/exit", "east, west"},
                      Mistake{"nobody", "/people", json::object(), "/people", "nobody"},
                      Mistake{"two_times", "/people/sources/0/table", json::parse("[[1, 2]]"),
                              "/people/sources/0", "one of them"},
                      Mistake{"menge_files", "/crowd", json::object(), "/crowd", "unknown"},
                      Mistake{"no_such_disaster", "/disasters",
                              json::parse(R"([{"kind": "rain", "position": [0, 0]}])"),
                              "/disasters/0/kind", "fire"}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace throng::places
