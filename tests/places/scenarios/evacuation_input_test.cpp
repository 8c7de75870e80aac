// Input that a study takes from the literature: pre-movement times and speeds of a blueprint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "base/error.h"
#include "crowd/simulation.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "tests/places/scenarios/square.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"
#include "world/scenario.h"

namespace throng::scenarios {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using throng::testing::square;
using throng::testing::TemporaryFolder;

constexpr double kAlarmS = 5;

struct Sample {
  double mean = 0;
  double stddev = 0;
  double min = 0;
  double max = 0;
};

Sample make_sample(const std::vector<double>& values) {
  Sample sample;
  const auto count = static_cast<double>(values.size());
  sample.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  for (const double value : values) sample.stddev += std::pow(value - sample.mean, 2) / count;
  sample.stddev = std::sqrt(sample.stddev);
  std::tie(sample.min, sample.max) = std::pair(*std::min_element(values.begin(), values.end()),
                                               *std::max_element(values.begin(), values.end()));
  return sample;
}

class EvacuationInput : public ::testing::Test {
 protected:
  EvacuationInput() {
    blueprint["people"].erase("sources");
    blueprint["people"].erase("lines");
    blueprint["people"]["in_groups"] = 0;  // people who stay together have one time
    blueprint["disasters"] = {{{"kind", "fire"},
                               {"position", {17, 17}},
                               {"start_s", kAlarmS},
                               {"radius_m", 0.4},
                               {"max_radius_m", 0.4},
                               {"noticed_m", 200},
                               {"notice_growth_mps", 0}}};
  }

  crowd::Simulation load() {
    const world::Scenario scenario = world::load_scenario(
        make_scenario(blueprint, "square.blueprint.json", folder.path(), "sq"), "sq");
    crowd::LoadOptions options;
    options.model = "weidmann";
    return {scenario.scene_file, scenario.behavior_file, options};
  }

  /// Seconds from the alarm until each person flees, of those who do before the end.
  std::vector<double> pre_movement_s(double until_s) {
    crowd::Simulation crowd = load();
    std::vector<double> times;
    std::vector<bool> flees(crowd.agent_count(), false);
    while (crowd.time_s() < kAlarmS + until_s) {
      crowd.step();
      for (std::size_t i = 0; i < flees.size(); ++i) {
        const std::string_view state = crowd.state_names()[crowd.states()[i]];
        if (flees[i] || state != "Flee") continue;
        flees[i] = true;
        times.push_back(crowd.time_s() - kAlarmS);
      }
    }
    return times;
  }

  /// The speeds that people want to have, of all or of one group's, at a time.
  std::vector<double> free_speeds_mps(double at_s) {
    crowd::Simulation crowd = load();
    while (crowd.time_s() < at_s) crowd.step();
    std::vector<double> speeds;
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      const std::string_view state = crowd.state_names()[crowd.states()[i]];
      if (state == "Danger" || state == "Away" || state == "Out") continue;
      speeds.push_back(crowd.desired_speeds_mps()[i]);
    }
    return speeds;
  }

  std::string refusal() {
    try {
      load();
    } catch (const InputError& error) {
      return error.problems().front().where + ": " + error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder;
  json blueprint = square();
};

constexpr std::size_t kPeople = 150;

TEST_F(EvacuationInput, PreMovementTimesAreThoseOfTheBlueprint) {
  blueprint["people"]["pre_movement_s"] = {{"normal", {20, 4}}};
  const std::vector<double> normal = pre_movement_s(40);
  ASSERT_EQ(normal.size(), kPeople);
  EXPECT_NEAR(make_sample(normal).mean, 20, 1.2);
  EXPECT_NEAR(make_sample(normal).stddev, 4, 0.8);
  blueprint["people"]["pre_movement_s"] = {{"uniform", {10, 12}}};
  const Sample uniform = make_sample(pre_movement_s(20));
  EXPECT_GE(uniform.min, 9.9);
  EXPECT_LE(uniform.max, 12.3);
  blueprint["people"]["pre_movement_s"] = {{"lognormal", {8, 0.6}}, {"max", 15}};
  std::vector<double> lognormal = pre_movement_s(20);
  ASSERT_EQ(lognormal.size(), kPeople);
  EXPECT_LE(make_sample(lognormal).max, 15.3);
  std::sort(lognormal.begin(), lognormal.end());
  // 85.3 % of all times are up to 15 s; their median is the 42.6 % quantile: 8 exp(0.6 * -0.185).
  EXPECT_NEAR(lognormal[kPeople / 2], 7.2, 0.9);
}

TEST_F(EvacuationInput, ANumberIsEverybodysPreMovementTime) {
  blueprint["people"]["pre_movement_s"] = 7;
  const Sample all = make_sample(pre_movement_s(12));
  EXPECT_NEAR(all.min, 7, 0.3);
  EXPECT_NEAR(all.max, 7, 0.3);
  blueprint["people"]["pre_movement_s"] = 0;
  EXPECT_LE(make_sample(pre_movement_s(2)).max, 0.5);
}

TEST_F(EvacuationInput, PeopleFleeAtTheSpeedOfTheBlueprint) {
  blueprint["people"]["pre_movement_s"] = 0;
  EXPECT_NEAR(make_sample(free_speeds_mps(kAlarmS + 2)).mean, 2, 0.1) << "the default";
  blueprint["people"]["evacuation_speed_mps"] = {{"normal", {1.2, 0.1}}};
  const Sample slower = make_sample(free_speeds_mps(kAlarmS + 2));
  EXPECT_NEAR(slower.mean, 1.2, 0.03);
  EXPECT_NEAR(slower.stddev, 0.1, 0.03);
  blueprint["people"]["evacuation_speed_mps"] = "unchanged";
  EXPECT_EQ(free_speeds_mps(kAlarmS + 2), free_speeds_mps(1));
}

TEST_F(EvacuationInput, GroupsHaveSpeedsOfTheirOwn) {
  json elderly = blueprint["people"]["groups"][0];
  elderly["count"] = 50;
  elderly["speed_mps"] = {{"uniform", {0.5, 0.8}}};
  blueprint["people"]["groups"][0]["count"] = 100;
  blueprint["people"]["groups"].push_back(elderly);
  blueprint["people"]["speed_mps"] = {{"uniform", {1.2, 1.6}}};
  const std::vector<double> speeds = free_speeds_mps(0.2);
  ASSERT_EQ(speeds.size(), kPeople);
  const auto count = [&](double low, double high) {
    return std::count_if(speeds.begin(), speeds.end(),
                         [&](double speed) { return speed >= low && speed <= high; });
  };
  EXPECT_EQ(count(0.5, 0.8001), 50);
  EXPECT_EQ(count(1.2, 1.6001), 100);
}

TEST_F(EvacuationInput, MistakesAreNamed) {
  const auto with = [&](const char* field, const json& value) {
    blueprint = square();
    blueprint["people"][field] = value;
    return refusal();
  };
  EXPECT_THAT(with("pre_movement_s", "soon"), HasSubstr("/people/pre_movement_s"));
  EXPECT_THAT(with("pre_movement_s", -1), HasSubstr("a number from 0 to 3600"));
  EXPECT_THAT(with("pre_movement_s", {{"normal", {20}}}), HasSubstr("[mean, standard deviation]"));
  EXPECT_THAT(with("pre_movement_s", {{"lognorml", {20, 1}}}), HasSubstr("lognormal"));
  EXPECT_THAT(with("pre_movement_s", {{"lognormal", {0, 1}}}), HasSubstr("above 0"));
  EXPECT_THAT(with("pre_movement_s", {{"lognormal", {20, 1}}, {"max", 10}}), HasSubstr("between"));
  EXPECT_THAT(with("pre_movement_s", {{"uniform", {20, 10}}}), HasSubstr("lower one first"));
  EXPECT_THAT(with("pre_movement_s", {{"uniform", {1, 2}}, {"max", 10}}), HasSubstr("max"));
  EXPECT_THAT(with("evacuation_speed_mps", "same"), HasSubstr("unchanged"));
  EXPECT_THAT(with("speed_mps", 30), HasSubstr("/people/speed_mps"));
  EXPECT_THAT(with("speed_mps", 1.2), ::testing::Eq("accepted"));
}

}  // namespace
}  // namespace throng::scenarios
