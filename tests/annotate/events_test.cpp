// Events of a run, on a trace made by hand.
#include "annotate/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace throng::annotate {
namespace {

using nlohmann::json;
using testing::ElementsAre;

constexpr int kSteps = 5;

// A hazard; a person who stays and lies from step 2 to 3; one who arrives at step 1 and departs at
// step 4; a drone that rises.
world::Trace eventful_trace() {
  world::Trace trace;
  trace.header.dt_s = 0.5;
  trace.header.role = {world::AgentRole::disaster, world::AgentRole::person,
                       world::AgentRole::person};
  trace.header.radius_m.assign(3, 0.2F);
  trace.header.pref_speed_mps.assign(3, 1.3F);
  trace.header.group.assign(3, -1);
  trace.header.state_names = {"Walk"};
  trace.header.exit_ids = {"north"};
  trace.header.drone_ids = {"d1", "d2"};
  for (int step = 0; step < kSteps; ++step) {
    const auto x = static_cast<float>(step);
    trace.time_s.push_back(0.5 * step);
    trace.position.insert(trace.position.end(), {{9, 9}, {x, 2}, {-x, 3}});
    trace.flags.insert(trace.flags.end(), {world::kPresent, world::kPresent, 0});
    if (step >= 1 && step < 4) trace.flags.back() = world::kPresent;
  }
  const std::size_t values = trace.position.size();
  trace.velocity.assign(values, {0, 0});
  trace.yaw_rad.assign(values, 0);
  trace.desired_speed_mps.assign(values, 1);
  trace.state.assign(values, 0);
  trace.exit_intent.assign(values, -1);
  for (const std::size_t step : {2U, 3U}) trace.flags[trace.at(step, 1)] |= world::kFallen;
  world::DroneSample low;
  low.position = {1, 2, 3};
  world::DroneSample high;
  high.time_s = 2;
  high.position = {1, 2, 5};
  trace.drones = {{low, high}, {low, high}};
  trace.events = {
      {0.6, world::NearMiss{0, world::Partner::person, 1, 0.75, 0.5}},
      {1.0, world::PersonFall{1, true, 31.5, 0}},
      {1.0, world::Collision{0, world::Partner::drone, 1, 2.25, 4}},
      {1.5, world::AgentEscaped{2, 0}},
      {1.75, world::ExitClosed{0}},
  };
  return trace;
}

std::vector<json> record_events(const world::Trace& trace, const std::vector<double>& frames_s) {
  world::Scenario scenario;
  scenario.inside.bounds = {{-50, -50}, {50, 50}};
  scenario.alarm = world::Alarm{};
  std::istringstream lines(events_jsonl(trace, scenario, 3, frames_s));
  std::vector<json> events;
  for (std::string line; std::getline(lines, line);) events.push_back(json::parse(line));
  return events;
}

TEST(Events, AreInOrderOfTimeWithTheFrameBefore) {
  std::vector<std::string> types;
  std::vector<int> frames;
  for (const json& event : record_events(eventful_trace(), {0.55, 1.0, 1.6})) {
    types.push_back(event.at("type"));
    frames.push_back(event.value("frame", -1));
  }
  EXPECT_THAT(types, ElementsAre("arrives", "near_miss", "falls", "collision", "lies_down",
                                 "exit_closes", "gets_up", "departs"));
  EXPECT_THAT(frames, ElementsAre(-1, 0, 1, 1, 1, 2, 2, 2));
}

TEST(Events, HavePersonDronePlaceAndValues) {
  const std::vector<json> events = record_events(eventful_trace(), {});
  EXPECT_EQ(events[0], json::parse(R"({"time_s": 0.5, "type": "arrives", "track_id": 3000003,
                                       "position": [-1.0, 3.0]})"));
  EXPECT_EQ(events[1], json::parse(R"({"time_s": 0.6, "type": "near_miss", "drone": "d1",
                            "drone_position": [1.0, 2.0, 3.6], "partner": "person",
                            "track_id": 3000002, "position": [1.0, 2.0], "distance_m": 0.75,
                            "contact_s": 0.5})"));
  EXPECT_EQ(events[2], json::parse(R"({"time_s": 1.0, "type": "falls", "track_id": 3000002,
                                       "position": [2.0, 2.0], "cause": "drone",
                                       "impulse_ns": 31.5})"));
  EXPECT_EQ(events[3].at("other_drone"), "d2");
  EXPECT_EQ(events[5], json::parse(R"({"time_s": 1.75, "type": "exit_closes", "exit": "north"})"));
  EXPECT_EQ(events[7].at("position"), json::parse("[-3.0, 3.0]")) << "where the person was last";
}

// As in metrics: the person who departs far from any exit has vanished, and nobody else leaves.
TEST(Events, VanishingIsNoEscape) {
  for (const json& event : record_events(eventful_trace(), {})) {
    EXPECT_NE(event.at("type"), "escapes");
  }
}

TEST(Events, EscapesHaveTheExitThatWasUsed) {
  world::Trace trace = eventful_trace();
  trace.header.exit_ids = {"north", "east"};
  trace.events = {{1.5, world::AgentEscaped{1, 0}}};  // heads for the north, but has gone east
  world::Scenario scenario;
  scenario.inside.bounds = {{-50, -50}, {2.6, 50}};
  scenario.exits.resize(2);
  scenario.exits[0].id = "north";
  scenario.exits[0].from = {-2, 40};
  scenario.exits[0].to = {2, 40};
  scenario.exits[0].outward = {0, 1};
  scenario.exits[1].id = "east";
  scenario.exits[1].from = {2.5, 0};
  scenario.exits[1].to = {2.5, 4};
  scenario.exits[1].outward = {1, 0};
  std::istringstream lines(events_jsonl(trace, scenario, 3, std::vector<double>{}));
  std::vector<json> escapes;
  for (std::string line; std::getline(lines, line);) {
    const json event = json::parse(line);
    if (event.at("type") == "escapes") escapes.push_back(event);
  }
  ASSERT_EQ(escapes.size(), 1U);
  EXPECT_EQ(escapes[0].at("exit"), "east");
  EXPECT_EQ(escapes[0].at("time_s"), 1.5);
}

}  // namespace
}  // namespace throng::annotate
