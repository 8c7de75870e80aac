// A yard with two doors, a policy that flies there as if it had no mass, and people for it to see.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sim/policies/policy_table.h"
#include "world/scenario.h"

namespace throng::sim::testing {

/// 40 m x 40 m; the left door is 2 m wide, the right one 3 m.
inline world::Scenario yard() {
  world::Scenario scenario;
  scenario.inside.bounds = {{-20, -20}, {20, 20}};
  scenario.exits = {{"left", {-20, -1}, {-20, 1}, {-1, 0}, true, {{3, 0}}},
                    {"right", {20, -1.5}, {20, 1.5}, {1, 0}, true, {{3, 1}}}};
  return scenario;
}

class IdealFlight {
 public:
  IdealFlight(const world::Scenario& scenario, DroneMission mission, const Eigen::Vector3d& start)
      : scenario_(scenario), mission_(std::move(mission)) {
    state_.position = start;
    policy_ = find_policy(mission_.policy)->make({mission_, start, 0, {}, &scenario_, 0});
  }

  /// One step of the crowd, 0.1 s; the policy is asked ten times. Returns where the drone is.
  const Eigen::Vector3d& step(const WorldView& seen) {
    WorldView view = seen;
    view.time_s = time_s_;
    view.exit_flow_per_s.resize(scenario_.exits.size());
    view.drones = {{state_.position, state_.velocity, policy_->beacon(), policy_->plan()}};
    policy_->see(view);
    for (int i = 0; i < 10; ++i) {
      setpoint_ = policy_->next(state_, 0.01);
      state_.position = setpoint_.position;
      state_.velocity = setpoint_.velocity;
    }
    time_s_ += 0.1;
    return state_.position;
  }

  const Policy& policy() const { return *policy_; }
  const Setpoint& setpoint() const { return setpoint_; }
  double time_s() const { return time_s_; }

 private:
  const world::Scenario& scenario_;
  DroneMission mission_;
  std::unique_ptr<Policy> policy_;
  FlightState state_;
  Setpoint setpoint_;
  double time_s_ = 0;
};

/// People in rows of ten, 1 m apart, about `middle`, who head for an exit.
inline std::vector<PersonSeen> people_about(const Eigen::Vector2d& middle, int count, int exit) {
  std::vector<PersonSeen> people;
  for (int i = 0; i < count; ++i) {
    people.push_back(
        {middle + Eigen::Vector2d(i % 10 - 4.5, i / 10 - count / 20.0), {0.5, 0}, exit});
  }
  return people;
}

inline DroneMission mission_with_policy(const std::string& policy) {
  DroneMission mission;
  mission.id = "d1";
  mission.policy = policy;
  return mission;
}

}  // namespace throng::sim::testing
