// Drones that guide people, in whole runs of the square.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/files/files.h"
#include "base/files/resources.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/guidance_loop.h"
#include "sim/recording/pilot_log.h"
#include "sim/run.h"
#include "tests/sim/missions.h"
#include "tests/world/temporary_folder.h"
#include "world/trace.h"

namespace throng::sim {
namespace {

namespace fs = std::filesystem;

world::Scenario square(const std::string& id) {
  return scenarios::find_scenario(source_folder() / "scenarios", "city_square/" + id);
}

RunSpec guided_run(const std::string& policy, double duration_s) {
  RunSpec spec;
  spec.seed = 3;
  spec.duration_s = duration_s;
  DroneMission mission;
  mission.id = "d1";
  mission.policy = policy;
  mission.start = Eigen::Vector3d(0, 0, 20);
  mission.moves_goal = world::GoalRef{99, 0};
  spec.drones = {mission};
  return spec;
}

/// How many ever followed a drone, and when the first did.
class FollowerCount : public RunObserver {
 public:
  void begin(const world::TraceHeader& header) override {
    for (const std::string& name : header.state_names) follow_.push_back(name == "Follow");
    seen_.resize(header.agent_count());
  }
  void step(const world::CrowdStep& step) override {
    ++steps;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (!follow_[step.state[i]] || seen_[i]) continue;
      seen_[i] = true;
      if (count++ == 0) first_s = step.time_s;
    }
  }
  bool done() const override { return enough > 0 && count >= enough; }

  int count = 0;
  int enough = 0;
  int steps = 0;
  double first_s = -1;

 private:
  std::vector<bool> follow_;
  std::vector<bool> seen_;
};

TEST(Guidance, BalanceLeadsPeopleInThePapersSquare) {
  RunSpec spec = guided_run("balance", 40);
  spec.crowd.compat = crowd::Compat::huang2016;
  FollowerCount followers;
  simulate(square("huang2016/crowded_exit_blocked"), spec, followers);
  EXPECT_GE(followers.count, 10);
}

TEST(Guidance, ADroneAlertsUnawarePeople) {
  FollowerCount followers;
  followers.enough = 5;
  simulate(square("huang2016/nearest_exit_navigated"), guided_run("balance", 30), followers);
  EXPECT_GE(followers.count, 5);
  EXPECT_LT(followers.steps, 301) << "an observer that has seen enough ends the run";
}

TEST(Guidance, NobodyFollowsWhereNobodyComplies) {
  RunSpec spec = guided_run("balance", 30);
  spec.crowd.compliance = 0;
  for (const crowd::Compat compat : {crowd::Compat::none, crowd::Compat::huang2016}) {
    spec.crowd.compat = compat;
    FollowerCount followers;
    simulate(square(compat == crowd::Compat::none ? "huang2016/nearest_exit_navigated"
                                                  : "huang2016/nearest_exit"),
             spec, followers);
    EXPECT_EQ(followers.count, 0);
  }
}

TEST(Guidance, PartialComplianceLosesSome) {
  RunSpec spec = guided_run("balance", 25);
  const auto count = [&](double compliance) {
    spec.crowd.compliance = compliance;
    FollowerCount followers;
    simulate(square("huang2016/nearest_exit_navigated"), spec, followers);
    return followers.count;
  };
  const int all = count(1);
  const int some = count(0.4);
  EXPECT_GT(some, 0);
  EXPECT_LT(some, all);
}

TEST(Guidance, ARunCanBeFlownAgainFromItsPilotLog) {
  const throng::testing::TemporaryFolder folder;
  const world::Scenario scenario = square("huang2016/nearest_exit_navigated");
  RunSpec spec = guided_run("balance", 20);
  spec.people = 100;
  simulate(scenario, spec, folder.path() / "first.h5", {}, {}, folder.path() / "logs");
  const fs::path log = folder.path() / "logs" / "d1.csv";
  spec.drones[0].policy = "pilot_log";
  spec.drones[0].guidance.setpoints = parse_pilot_log(read_file(log), log.string());
  simulate(scenario, spec, folder.path() / "again.h5");
  const world::Trace first = world::read_trace(folder.path() / "first.h5");
  const world::Trace again = world::read_trace(folder.path() / "again.h5");
  for (double time_s = 0; time_s <= 20; time_s += 1) {
    EXPECT_LT((first.drone_at(0, time_s).position - again.drone_at(0, time_s).position).norm(), 1)
        << time_s;
  }
}

class Beacons : public RunObserver {
 public:
  void pilot(std::size_t drone, const PilotSample& sample) override {
    lit.resize(std::max(lit.size(), drone + 1));
    lit[drone] = sample.beacon;
  }
  std::vector<bool> lit;
};

TEST(Guidance, ADroneThatHasComeDownLeadsNobody) {
  std::vector<PlannedDrone> drones = {testing::planned_drone({0, 0, 20}, {}, 1),
                                      testing::planned_drone({5, 0, 20}, {}, 1)};
  for (PlannedDrone& drone : drones) drone.mission.guidance.beacon = true;
  drones[1].airframe.mass_kg *= 4;  // more than its rotors lift, as after a crash
  const std::vector<world::AgentRole> roles;
  const world::Scenario scenario = square("nearest_exit");
  Flight flight(scenario.buildings, drones, 0.1, 1.0 / 480,
                {[](std::size_t, const world::DroneSample&) {}, [](const world::TraceEvent&) {}});
  GuidanceLoop guidance(scenario, roles, drones, 1, 0.1);
  Beacons beacons;
  guidance.report(flight, beacons);
  EXPECT_EQ(beacons.lit, (std::vector<bool>{true, true}));
  for (int i = 0; i < 40; ++i) flight.advance();
  ASSERT_LT(flight.state(1).position.z(), 12);
  guidance.report(flight, beacons);
  EXPECT_EQ(beacons.lit, (std::vector<bool>{true, false}));
}

}  // namespace
}  // namespace throng::sim
