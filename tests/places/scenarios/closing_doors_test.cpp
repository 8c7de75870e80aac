// Exits of a blueprint that close, on a small square with two doors.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "crowd/simulation.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/blueprint/crowd_scene.h"
#include "tests/places/scenarios/square.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"

namespace throng::scenarios {
namespace {

using nlohmann::json;
using throng::testing::TemporaryFolder;

constexpr double kClosesS = 6;

/// The square with nobody but a group that does this on its east half.
json crowded_square(const char* doing, int count = 80) {
  json square = throng::testing::square();
  square["people"] = {
      {"groups", json::array({{{"doing", doing}, {"box", {2, -15, 18, 15}}, {"count", count}}})}};
  return square;
}

json fire_at(double start_s, double blocked_m) {
  return {{"kind", "fire"},  {"position", {10, 12}},   {"start_s", start_s},
          {"radius_m", 0.5}, {"blocked_m", blocked_m}, {"growth_mps", 0},
          {"noticed_m", 60}, {"max_radius_m", 0.5}};
}

/// A run in which passages of the two doors are counted at each step.
class CountedRun {
 public:
  explicit CountedRun(const json& blueprint, const char* model = "weidmann")
      : scenario_(load(blueprint)), crowd(start(scenario_, model)) {}

  void until(double end_s) {
    while (crowd.time_s() < end_s - 1e-6) {
      const std::vector<Eigen::Vector2f> before(crowd.positions().begin(), crowd.positions().end());
      const std::vector<std::uint8_t> present(crowd.present().begin(), crowd.present().end());
      crowd.step();
      for (std::size_t i = 0; i < before.size(); ++i) {
        if (present[i] == 0 || crowd.present()[i] == 0) continue;
        const Eigen::Vector2f& after = crowd.positions()[i];
        const auto passes = [&](float beyond_m, float was, float is) {
          return (is >= beyond_m ? 1 : 0) - (was >= beyond_m ? 1 : 0);
        };
        if (std::abs(after.y()) < 2) east += passes(20, before[i].x(), after.x());
        if (std::abs(after.y()) < 1.8) west += passes(20, -before[i].x(), -after.x());
      }
    }
  }

  int in_state(const std::string& name) const {
    int count = 0;
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      if (crowd.present()[i] != 0 && crowd.state_names()[crowd.states()[i]] == name) ++count;
    }
    return count;
  }

 private:
  static world::Scenario load(const json& blueprint) {
    return world::load_scenario(
        make_scenario(blueprint, "square.blueprint.json", folder().path(), "sq"), "sq");
  }
  static const TemporaryFolder& folder() {
    static const TemporaryFolder kFolder;
    return kFolder;
  }
  static crowd::Simulation start(const world::Scenario& scenario, const char* model) {
    crowd::LoadOptions options;
    options.model = model;
    return {scenario.scene_file, scenario.behavior_file, options};
  }

  world::Scenario scenario_;

 public:
  crowd::Simulation crowd;
  int east = 0;  // passages outward less those inward
  int west = 0;
};

class ClosingDoors : public ::testing::TestWithParam<const char*> {};

TEST_P(ClosingDoors, ArePassedByNobodyAndPeopleLeaveByAnother) {
  for (const char* doing : {"leave", "cross"}) {
    json blueprint = crowded_square(doing);
    blueprint["exits"][0]["closes_at_s"] = kClosesS;
    CountedRun run(blueprint, GetParam());
    run.until(kClosesS);
    EXPECT_GT(run.east, 3) << doing;
    EXPECT_LT(run.east, 60) << doing;
    const int before = run.east;
    run.until(90);
    EXPECT_EQ(run.east, before) << doing;
    EXPECT_EQ(run.east + run.west, 80) << doing;
  }
}

TEST_P(ClosingDoors, StopThoseWhoFlee) {
  json blueprint = crowded_square("stroll");
  blueprint["disasters"] = json::array({fire_at(1, 0)});
  blueprint["exits"][0]["closes_at_s"] = kClosesS;
  CountedRun run(blueprint, GetParam());
  run.until(kClosesS);
  const int before = run.east;
  EXPECT_GT(before, 0);
  run.until(90);
  EXPECT_EQ(run.east, before);
  EXPECT_EQ(run.in_state("Flee"), 0);
}

TEST_P(ClosingDoors, KeepPeopleInsideIfAllAreClosed) {
  json blueprint = crowded_square("leave");
  for (json& exit : blueprint["exits"]) exit["closes_at_s"] = kClosesS;
  CountedRun run(blueprint, GetParam());
  run.until(kClosesS);
  const int before = run.east + run.west;
  run.until(60);
  EXPECT_EQ(run.east + run.west, before);
  EXPECT_EQ(run.in_state("Leave"), 80 - before);
}

INSTANTIATE_TEST_SUITE_P(Models, ClosingDoors,
                         ::testing::Values("weidmann", "ttc", "orca", "helbing"));

TEST(ClosedDoors, ArePassedByNobodyFromTheStart) {
  for (const char* doing : {"leave", "cross"}) {
    json blueprint = crowded_square(doing);
    blueprint["exits"][0]["open"] = false;
    CountedRun run(blueprint);
    blueprint["exits"][0].erase("open");
    blueprint["exits"][0]["closes_at_s"] = 0;
    CountedRun zero(blueprint);
    run.until(90);
    zero.until(90);
    EXPECT_EQ(run.east, 0) << doing;
    EXPECT_EQ(run.west, 80) << doing;
    EXPECT_TRUE(std::equal(run.crowd.positions().begin(), run.crowd.positions().end(),
                           zero.crowd.positions().begin(), zero.crowd.positions().end()));
  }
}

TEST(ClosedDoors, AreNobodysDestination) {
  json blueprint = crowded_square("wait", 1);
  json& exits = blueprint["exits"];
  exits[0]["open"] = false;
  blueprint["people"]["sources"] = json::array({{{"doing", "cross"},
                                                 {"from", {-10, -10}},
                                                 {"to", {-10, 10}},
                                                 {"towards", "east"},
                                                 {"table", {{1, 20}}}}});
  CountedRun run(blueprint);
  run.until(20);
  EXPECT_EQ(run.in_state("To_east"), 0);
  run.until(90);
  EXPECT_EQ(run.east, 0);
  EXPECT_EQ(run.west, 20);
  exits[1]["open"] = false;
  CountedRun none(blueprint);
  none.until(30);
  EXPECT_EQ(none.east + none.west, 0);
  EXPECT_EQ(none.in_state("To_east"), 20) << "wait before one of those that are closed";
}

TEST(ClosingDoors, ChangeNothingBefore) {
  json blueprint = crowded_square("leave");
  CountedRun without(blueprint);
  blueprint["exits"][0]["closes_at_s"] = 1000;
  CountedRun with(blueprint);
  without.until(30);
  with.until(30);
  EXPECT_TRUE(std::equal(with.crowd.positions().begin(), with.crowd.positions().end(),
                         without.crowd.positions().begin(), without.crowd.positions().end()));
}

TEST(ClosingDoors, AreLearnedOfBySight) {
  json blueprint = crowded_square("leave", 1);
  blueprint["exits"][0]["closes_at_s"] = kClosesS;
  blueprint["exits"][1]["closes_at_s"] = 1000;
  // One before the door, one behind a wall; both stand in for people who have farther to go.
  blueprint["people"]["speed_mps"] = 0.5;
  blueprint["buildings"].push_back({{"id", "wall"}, {"box", {9, -14, 9.4, 14}}, {"height_m", 3}});
  blueprint["people"]["groups"] =
      json::array({{{"doing", "leave"}, {"box", {13, -1, 15, 1}}, {"count", 1}},
                   {{"doing", "leave"}, {"box", {6, 11, 8, 13}}, {"count", 1}}});
  CountedRun run(blueprint);
  run.until(kClosesS - 0.1);
  for (const crowd::GoalId& goal : run.crowd.goals()) EXPECT_EQ(goal.goal, 0);
  run.until(kClosesS + 0.7);
  EXPECT_EQ(run.crowd.goals()[0].goal, 1);
  EXPECT_EQ(run.crowd.goals()[1].goal, 0) << "behind the wall";
  run.until(60);
  EXPECT_EQ(run.crowd.goals()[1].goal, 1) << "has come around it";
  run.until(200);
  EXPECT_EQ(run.west, 2);
}

TEST(ClosingDoors, ThatADisasterClosesStopThoseWhoHaveNotNoticedIt) {
  json blueprint = crowded_square("leave");
  json fire = fire_at(kClosesS, 3);
  fire["position"] = {19, 0};
  fire["noticed_m"] = 0.1;
  fire["notice_growth_mps"] = 0;
  blueprint["disasters"] = json::array({fire});
  CountedRun run(blueprint);
  run.until(kClosesS);
  const int before = run.east;
  EXPECT_GT(before, 0);
  run.until(120);
  EXPECT_EQ(run.east, before);
  EXPECT_EQ(run.east + run.west, 80);
}

TEST(ClosingDoors, LetNobodyIn) {
  json blueprint = crowded_square("wait", 1);
  blueprint["people"]["sources"] = json::array(
      {{{"doing", "cross"}, {"exit", "east"}, {"towards", "west"}, {"per_minute", 60}}});
  blueprint["exits"][0]["closes_at_s"] = 20;
  CountedRun run(blueprint);
  run.until(20);
  const int before = run.east;
  EXPECT_LT(before, -5);
  run.until(100);
  EXPECT_EQ(run.east, before);
  EXPECT_EQ(run.west, -before);
}

TEST(StrollersWhoArrive, WalkAnywhereIfNoGroupStrolls) {
  json blueprint = crowded_square("wait", 3);
  blueprint["people"]["sources"] =
      json::array({{{"doing", "stroll"}, {"exit", "east"}, {"per_minute", 60}}});
  CountedRun run(blueprint);
  run.until(30);
  EXPECT_GT(run.in_state("Stroll") + run.in_state("Pause"), 10);
}

}  // namespace
}  // namespace throng::scenarios
