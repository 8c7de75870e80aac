// Recorded people as a crowd: their positions and headings over time, and their use in them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "sim/people/crowd_source.h"
#include "sim/run.h"
#include "tests/sim/recordings.h"

namespace throng::sim {
namespace {

using testing::make_recording;
using testing::RecordedWalk;

TEST(Replay, KeepsTheStepOfUsualRecordingsAndDividesOthers) {
  EXPECT_DOUBLE_EQ(replay_step_s(1.0 / 16), 1.0 / 16);
  EXPECT_DOUBLE_EQ(replay_step_s(1.0 / 25), 1.0 / 25);
  EXPECT_DOUBLE_EQ(replay_step_s(1.0), 0.2);
  EXPECT_DOUBLE_EQ(replay_step_s(0.4), 0.4 / 2);
  EXPECT_NEAR(replay_step_s(1.0 / 120), 1.0 / 60, 1e-15);
  EXPECT_NEAR(replay_step_s(1.0 / 100), 1.0 / 50, 1e-15);
}

TEST(Replay, PeopleAreThereInTheFramesThatHaveThem) {
  // One a second: replayed five times a second. The second person comes late and goes early.
  const auto recording = make_recording(1.0, 4, {{0, 3, {0, 0}, {1, 0}}, {1, 2, {0, 5}, {0, 1}}});
  const auto crowd = replayed(recording, 1);
  EXPECT_DOUBLE_EQ(crowd->dt_s(), 0.2);
  std::vector<int> there;
  for (int step = 0; step <= 20; ++step) {
    there.push_back(crowd->present()[0] + 2 * crowd->present()[1]);
    if (crowd->present()[0] != 0) {
      EXPECT_NEAR(crowd->positions()[0].x(), 0.2 * step, 1e-5);
      EXPECT_NEAR(crowd->velocities()[0].x(), 1, 1e-5);
    }
    crowd->step();
  }
  EXPECT_EQ(there,
            (std::vector<int>{1, 1, 1, 1, 1, 3, 3, 3, 3, 3, 3, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0}));
}

TEST(Replay, FacesTheWayWalkedHoweverTheHeadSways) {
  auto recording =
      make_recording(1.0 / 25, 101, {{0, 100, {0, 0}, {1, 0}}, {0, 100, {9, 9}, {0, 0}}});
  auto swaying = std::make_shared<world::Trace>(*recording);
  for (std::size_t step = 0; step < swaying->steps(); ++step) {
    const auto sway = static_cast<float>(0.05 * std::sin(2 * EIGEN_PI * swaying->time_s[step]));
    swaying->position[swaying->at(step, 0)].y() += sway;
    swaying->position[swaying->at(step, 1)].y() += sway;
  }
  const auto crowd = replayed(swaying, 1);
  const float stands = crowd->now().yaw_rad[1];
  for (int step = 0; step <= 100; ++step) {
    EXPECT_NEAR(crowd->now().yaw_rad[0], 0, 0.2) << step;
    EXPECT_EQ(crowd->now().yaw_rad[1], stands) << step;
    crowd->step();
  }
}

TEST(Replay, AbsentPeopleStayAway) {
  const auto crowd =
      replayed(make_recording(0.1, 11, {{0, 10, {0, 0}, {1, 0}}, {0, 10, {5, 0}, {1, 0}}}), 1);
  crowd->set_present(0, false);
  crowd->step();
  EXPECT_EQ(crowd->present()[0], 0);
  EXPECT_EQ(crowd->present()[1], 1);
}

class Steps : public RunObserver {
 public:
  void begin(const world::TraceHeader& header) override { header_ = header; }
  void step(const world::CrowdStep& step) override { steps_.push_back(step); }
  void drone(std::size_t, const world::DroneSample& sample) override { drone_.push_back(sample); }
  void event(const world::TraceEvent& event) override { events_.push_back(to_row(event)); }

  world::TraceHeader header_;
  std::vector<world::CrowdStep> steps_;
  std::vector<world::DroneSample> drone_;
  std::vector<world::EventRow> events_;
};

TEST(Replay, ARunHasThePeopleOfTheRecordingAndItsOwnDrones) {
  world::Scenario scenario;  // without a crowd of its own: nothing of it is read
  scenario.inside.bounds = {{-10, -10}, {10, 10}};
  scenario.exits = {{"east", {10, -1}, {10, 1}, {1, 0}, true, {{0, 0}}}};
  scenario.disaster_agents = {99};
  RunSpec spec;
  spec.duration_s = 2;
  spec.recorded = make_recording(0.0625, 33, {{0, 32, {9, 0}, {1, 0}}, {8, 16, {0, 0}, {0, 1}}});
  DroneMission mission;
  mission.id = "d1";
  mission.start = Eigen::Vector3d(0, 0, 10);
  spec.drones = {mission};
  Steps seen;
  EXPECT_TRUE(simulate(scenario, spec, seen).empty());
  ASSERT_EQ(seen.steps_.size(), 33U);
  EXPECT_EQ(seen.header_.dt_s, 0.0625);
  EXPECT_EQ(seen.header_.crowd.model, world::kRecordedCrowd);
  EXPECT_TRUE(seen.header_.exit_ids.empty());
  EXPECT_EQ(seen.steps_[7].flags[1], 0);
  EXPECT_EQ(seen.steps_[8].flags[1], world::kPresent);
  EXPECT_EQ(seen.steps_[17].flags[1], 0);
  EXPECT_NEAR(seen.drone_.back().time_s, 2, 1e-6);
  ASSERT_EQ(seen.events_.size(), 2U);  // one walks out, the other is gone
  EXPECT_EQ(seen.events_[0].type, "agent_escaped");
  EXPECT_NEAR(seen.events_[0].time_s, 1.0625, 1e-6);
  EXPECT_EQ(seen.events_[1].agent, 0 + (seen.events_[0].agent == 0 ? 1 : 0));
}

}  // namespace
}  // namespace throng::sim
