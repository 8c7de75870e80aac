// Drones flown by commands: their pilot logs repeat the flight exactly.
#include "sim/remote/remote_pilots.h"
#include "base/files/resources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/files/files.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/recording/pilot_log.h"
#include "sim/recording/trace_recorder.h"
#include "sim/run.h"
#include "tests/world/temporary_folder.h"
#include "world/scenario.h"

namespace throng::sim {
namespace {

namespace fs = std::filesystem;

constexpr int kSteps = 120;

world::Scenario square() {
  return scenarios::find_scenario(source_folder() / "scenarios", "city_square/nearest_exit");
}

RunSpec run_with_drones(int drones) {
  RunSpec spec;
  spec.seed = 11;
  spec.duration_s = 600;
  spec.wind.speed_mps = 4;
  for (int i = 0; i < drones; ++i) {
    DroneMission& mission = spec.drones.emplace_back();
    mission.id = "own" + std::to_string(i + 1);  // the scenario does not know it
    mission.start = Eigen::Vector3d(1.0 / 3 + 8 * i, 2, 12 + 1.0 / 7);
  }
  return spec;
}

/// Ahead with turns, sideways, up and down, the beacon now and then, home.
RemoteCommand command_at(int step, int drone) {
  RemoteCommand command;
  command.velocity_mps = {6 * std::cos(0.11 * step), 4 * std::sin(0.07 * step + drone),
                          step % 40 < 10 ? -1.5 : 0.7};
  command.yaw_rate_deg_s = step % 30 < 20 ? 77.7 : -45;
  command.beacon = step % 25 < 12;
  command.goes_home = step > 90;
  return command;
}

/// Gives a drone's command in a step.
using Steer = std::function<RemoteCommand(int step, int drone)>;

/// Flies, writes the trace, and returns the drones' logs.
std::vector<std::vector<PilotSample>> fly(const world::Scenario& scenario, const RunSpec& asked,
                                          const fs::path& trace, const Steer& steer = command_at) {
  RunSpec spec = asked;
  fly_remotely(spec, scenario);
  TraceRecorder recorder(trace, {});
  SteppedRun run(scenario, spec, recorder);
  RemotePilots pilots(scenario, run, spec);
  for (int step = 0; step < kSteps; ++step) {
    std::vector<RemoteCommand> commands;
    for (std::size_t i = 0; i < spec.drones.size(); ++i) {
      commands.push_back(steer(step, static_cast<int>(i)));
    }
    pilots.advance(commands);
    run.step();
  }
  run.finish();
  recorder.finish();
  std::vector<std::vector<PilotSample>> logs;
  for (std::size_t i = 0; i < spec.drones.size(); ++i) logs.push_back(pilots.log(i));
  return logs;
}

RunSpec replay_flight(const RunSpec& flown, const std::vector<std::vector<PilotSample>>& logs) {
  RunSpec spec = flown;
  spec.duration_s = kSteps * 0.1;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    spec.drones[i].policy = "pilot_log";
    // By the text, as people keep it.
    spec.drones[i].guidance.setpoints = parse_pilot_log(pilot_log_csv(logs[i]), "log.csv");
  }
  return spec;
}

TEST(RemotePilots, TheLogRepeatsTheFlightByteForByte) {
  const ::throng::testing::TemporaryFolder folder;
  const world::Scenario scenario = square();
  const RunSpec spec = run_with_drones(2);
  const auto logs = fly(scenario, spec, folder.path() / "flown.h5");
  simulate(scenario, replay_flight(spec, logs), folder.path() / "replayed.h5");
  EXPECT_EQ(read_file(folder.path() / "flown.h5"), read_file(folder.path() / "replayed.h5"));
  const world::Trace trace = world::read_trace(folder.path() / "flown.h5");
  EXPECT_GT((trace.drone_at(0, 6).position - trace.drone_at(0, 0).position).norm(), 3)
      << "the drone has flown somewhere";
}

TEST(RemotePilots, FlyRoutesPointByPointAndTurn) {
  const ::throng::testing::TemporaryFolder folder;
  const world::Scenario scenario = square();
  const RunSpec spec = run_with_drones(2);
  const std::vector<Eigen::Vector3d> corners = {{6, 2, 14}, {6, 9, 14}, {0, 9, 11}};
  const auto around = std::make_shared<const RemoteRoute>(RemoteRoute{corners, 4, EIGEN_PI / 2});
  const auto aside = std::make_shared<const RemoteRoute>(RemoteRoute{{{14, 6, 12}}, 6, {}});
  const auto steer = [&](int step, int drone) {
    RemoteCommand command;
    command.velocity_mps = {-9, -9, 0};  // the route counts
    command.route = drone == 0 ? around : step < 20 ? nullptr : aside;
    return command;
  };
  const auto logs = fly(scenario, spec, folder.path() / "flown.h5", steer);
  constexpr double kNearM = 0.6;
  std::size_t seen = 0;
  for (const PilotSample& sample : logs[0]) {
    if (seen < corners.size() && (sample.position - corners[seen]).norm() < kNearM) ++seen;
  }
  EXPECT_EQ(seen, corners.size());
  EXPECT_LT((logs[0].back().position - corners.back()).norm(), 0.01);
  EXPECT_NEAR(logs[0].back().yaw_rad, EIGEN_PI / 2, 1e-4);
  EXPECT_LT(logs[1][20].position.y(), 0) << "by its velocity until the route comes";
  EXPECT_LT((logs[1].back().position - aside->points[0]).norm(), 0.01);
  EXPECT_EQ(logs[1].back().yaw_rad, logs[1].front().yaw_rad);
  simulate(scenario, replay_flight(spec, logs), folder.path() / "replayed.h5");
  EXPECT_EQ(read_file(folder.path() / "flown.h5"), read_file(folder.path() / "replayed.h5"));
}

TEST(RemotePilots, TurnTheGimbalAsFastAsItTurns) {
  const ::throng::testing::TemporaryFolder folder;
  const world::Scenario scenario = square();
  RunSpec spec = run_with_drones(2);
  spec.drones[0].camera.pitch_deg = -30;
  spec.drones[1].camera.gimbal.model = camera::GimbalModel::rigid;
  const auto steer = [](int step, int /*drone*/) {
    RemoteCommand command;
    if (step >= 10) command.gimbal = {-75, 90};
    return command;
  };
  const auto logs = fly(scenario, spec, folder.path() / "flown.h5", steer);
  EXPECT_FALSE(logs[0][10].gimbal) << "as the job has it, until somebody turns it";
  ASSERT_TRUE(logs[0][11].gimbal);
  // 60 degrees a second, in steps of 0.1 s.
  EXPECT_NEAR(logs[0][11].gimbal->pitch_deg, -36, 1e-9);
  EXPECT_NEAR(logs[0][11].gimbal->yaw_deg, 6, 1e-9);
  EXPECT_NEAR(logs[0][15].gimbal->pitch_deg, -60, 1e-9);
  EXPECT_EQ(logs[0].back().gimbal, (camera::GimbalAngles{-75, 90}));
  EXPECT_FALSE(logs[1].back().gimbal) << "a rigid mount";
  // The log repeats it, as text, too.
  const auto read = parse_pilot_log(pilot_log_csv(logs[0]), "log.csv");
  for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i].gimbal, logs[0][i].gimbal) << i;
}

TEST(RemotePilots, KeepOutOfBuildingsAndOffTheGround) {
  const ::throng::testing::TemporaryFolder folder;
  world::Scenario scenario = square();
  scenario.buildings = {{"wall", {{15, -50}, {20, -50}, {20, 50}, {15, 50}}, 40}};
  RunSpec spec = run_with_drones(1);
  spec.wind = {};
  fly_remotely(spec, scenario);
  TraceRecorder recorder(folder.path() / "trace.h5", {});
  SteppedRun run(scenario, spec, recorder);
  RemotePilots pilots(scenario, run, spec);
  RemoteCommand into_the_wall;
  into_the_wall.velocity_mps = {99, 40, -99};
  for (int step = 0; step < kSteps; ++step) {
    pilots.advance({into_the_wall});
    run.step();
  }
  const PilotSample& last = pilots.log(0).back();
  EXPECT_LT(last.position.x(), 15 - 0.5);
  EXPECT_GT(last.position.x(), 10) << "it goes on along the wall";
  EXPECT_GT(last.position.y(), 5);
  EXPECT_LT(last.position.z(), 2);
  EXPECT_GT(last.position.z(), 0);
  // A job may fly it, too.
  EXPECT_NO_THROW(SteppedRun(scenario, replay_flight(spec, {pilots.log(0)}), recorder));
}

TEST(RemotePilots, KeepAwayFromEachOther) {
  const ::throng::testing::TemporaryFolder folder;
  const world::Scenario scenario = square();
  RunSpec spec = run_with_drones(2);
  spec.wind = {};
  fly_remotely(spec, scenario);
  TraceRecorder recorder(folder.path() / "trace.h5", {});
  SteppedRun run(scenario, spec, recorder);
  RemotePilots pilots(scenario, run, spec);
  RemoteCommand ahead;
  ahead.velocity_mps = {10, 0, 0};
  double min_m = 1e9;
  for (int step = 0; step < kSteps; ++step) {
    pilots.advance({ahead, {}});
    run.step();
    min_m = std::min(min_m, (pilots.log(0).back().position - pilots.log(1).back().position).norm());
  }
  EXPECT_GT(min_m, 2);
  EXPECT_LT(pilots.log(0).back().position.x(), pilots.log(1).back().position.x());
  EXPECT_NO_THROW(simulate(scenario, replay_flight(spec, {pilots.log(0), pilots.log(1)}),
                           folder.path() / "replayed.h5"));
}

TEST(RemotePilots, ComeHome) {
  const ::throng::testing::TemporaryFolder folder;
  const world::Scenario scenario = square();
  const RunSpec spec = run_with_drones(1);
  const auto logs = fly(scenario, spec, folder.path() / "trace.h5");
  const double at_90 = (logs[0][90].position - logs[0][0].position).norm();
  EXPECT_LT((logs[0].back().position - logs[0][0].position).norm(), at_90 - 5);
}

}  // namespace
}  // namespace throng::sim
