#include "spec/live/commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace throng::live {
namespace {

using nlohmann::json;

const std::vector<FlownDrone> kDrones = {{"left"}, {"right"}, {"rigid", false}};

/// "pointer: found" of every mistake.
std::vector<std::string> mistakes(const char* text) {
  try {
    commands_from_json(json::parse(text), kDrones);
  } catch (const InputError& error) {
    std::vector<std::string> list;
    for (const Problem& problem : error.problems()) {
      list.push_back(problem.where + ": " + problem.found);
    }
    return list;
  }
  return {};
}

TEST(Commands, GivenFieldsAreReadAndOthersAreNot) {
  const Commands commands =
      commands_from_json(json::parse(R"({"sequence": 7, "factor": 0.5, "view": "right",
                      "drones": [{"id": "right", "velocity_mps": [1, -2, 0.5]},
                                 {"id": "left", "yaw_rate_deg_s": -30, "beacon": true}]})"),
                         kDrones);
  EXPECT_EQ(commands.sequence, 7);
  EXPECT_EQ(commands.factor, 0.5);
  EXPECT_EQ(commands.view, "right");
  EXPECT_FALSE(commands.paused);
  ASSERT_EQ(commands.drones.size(), 2U);
  EXPECT_EQ(commands.drones[0].velocity_mps, (std::array<double, 3>{1, -2, 0.5}));
  EXPECT_FALSE(commands.drones[0].yaw_rate_deg_s);
  EXPECT_FALSE(commands.drones[0].beacon);
  EXPECT_EQ(commands.drones[1].yaw_rate_deg_s, -30);
  EXPECT_EQ(commands.drones[1].beacon, true);
  EXPECT_FALSE(commands.drones[1].return_home);
}

TEST(Commands, PrintedOnesAreReadAgain) {
  const json text = json::parse(
      R"({"paused": true, "sequence": 1, "drones": [{"id": "left", "return_home": true}]})");
  EXPECT_EQ(to_json(commands_from_json(text, kDrones)), text);
  EXPECT_EQ(commands_from_json(to_json(Commands{}), kDrones).drones.size(), 0U);
}

TEST(Commands, PlacesToFlyToAreReadAndPrinted) {
  const json text = json::parse(
      R"({"drones": [{"id": "left", "position_m": [1, 2.5, 10], "yaw_deg": -90, "speed_mps": 3},
                     {"id": "right", "waypoints_m": [[0, 0, 9], [4, 0, 9]]}]})");
  const Commands commands = commands_from_json(text, kDrones);
  EXPECT_EQ(commands.drones[0].position_m, (std::array<double, 3>{1, 2.5, 10}));
  EXPECT_EQ(commands.drones[0].yaw_deg, -90);
  EXPECT_FALSE(commands.drones[0].waypoints_m);
  ASSERT_EQ(commands.drones[1].waypoints_m.value().size(), 2U);
  EXPECT_EQ(to_json(commands), text);
  const auto found = mistakes(
      R"({"drones": [{"id": "left", "position_m": [1, 2], "speed_mps": 0},
                     {"id": "right", "waypoints_m": [[0, 0, 1e9], 4], "yaw_deg": "north"}]})");
  EXPECT_EQ(found.size(), 5U);
  EXPECT_EQ(found[0], "/drones/0/position_m: [1,2]");
  EXPECT_EQ(found[2].substr(0, 25), "/drones/1/waypoints_m/0: ");
}

TEST(Commands, GimbalsAreTurnedWhereThereAreSome) {
  const json text = json::parse(R"({"drones": [{"id": "left", "gimbal_deg": [-60, 20.5]}]})");
  EXPECT_EQ(commands_from_json(text, kDrones).drones[0].gimbal_deg,
            (std::array<double, 2>{-60, 20.5}));
  EXPECT_EQ(to_json(commands_from_json(text, kDrones)), text);
  EXPECT_EQ(
      mistakes(R"({"drones": [{"id": "left", "gimbal_deg": [31, 0]},
                                    {"id": "left", "gimbal_deg": [0, -181]},
                                    {"id": "left", "gimbal_deg": [0]},
                                    {"id": "left", "gimbal_deg": ["down", 0]},
                                    {"id": "rigid", "gimbal_deg": [0, 0]}]})"),
      (std::vector<std::string>{"/drones/0/gimbal_deg: [31,0]", "/drones/1/gimbal_deg: [0,-181]",
                                "/drones/2/gimbal_deg: [0]", "/drones/3/gimbal_deg: [\"down\",0]",
                                "/drones/4/gimbal_deg: a direction for a rigid camera"}));
}

TEST(Commands, EveryMistakeIsNamed) {
  const auto found = mistakes(
      R"({"faktor": 1, "factor": 11, "view": "middle", "paused": 1, "sequence": -1,
          "drones": [{"id": "lift"}, {"velocity_mps": [1, 2, "up"]}, 3, {"id": "left", "yaw_rate_deg_s": 1e3}]})");
  for (const char* pointer :
       {"/faktor", "/factor", "/view", "/paused", "/sequence", "/drones/0/id", "/drones/1/id",
        "/drones/1/velocity_mps", "/drones/2", "/drones/3/yaw_rate_deg_s"}) {
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const std::string& text) {
      return text.starts_with(pointer);
    })) << pointer;
  }
  EXPECT_EQ(mistakes(R"({"drones": {}})").size(), 1U);
  EXPECT_EQ(mistakes("{}").size(), 0U);
}

}  // namespace
}  // namespace throng::live
