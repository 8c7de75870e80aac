// Perception of drones: the true state of the crowd, or its estimate by a camera that counts
// people.
#pragma once

#include <deque>
#include <vector>

#include "sim/people/crowd_source.h"
#include "sim/recording/crowd_recorder.h"
#include "sim/sensors/world_view.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Computes the true view. It excludes agents that have escaped, are absent, lie on the ground or
/// are not persons, and people who have passed a door, unless they still follow a drone.
class CrowdObserver {
 public:
  /// `guide_goals`: per drone, the goal that it moves, if any. All references must outlive this
  /// object.
  CrowdObserver(const world::Scenario& scenario, const std::vector<world::AgentRole>& roles,
                const std::vector<std::optional<world::GoalRef>>& guide_goals, double step_s);

  /// Sets view() to the current state of the crowd, except the drones, which the caller sets.
  void look(const CrowdSource& crowd, const CrowdRecorder& recorder, double time_s);

  const WorldView& view() const { return view_; }
  WorldView& view() { return view_; }

 private:
  int guide_of(const crowd::GoalId& goal) const;
  void count_flows(std::size_t agent, const Eigen::Vector2d& place, std::vector<int>& out);

  const world::Scenario& scenario_;
  const std::vector<world::AgentRole>& roles_;
  const std::vector<std::optional<world::GoalRef>>& guide_goals_;
  std::vector<std::vector<int>> side_;  ///< per exit and agent: 1 beyond the door's line, -1 before
  std::vector<bool> left_;              ///< per agent: has passed a door
  std::deque<std::vector<int>> out_;  ///< per recent step, per exit: number of people who went out
  std::size_t flow_steps_;            ///< max size of `out_`
  double step_s_;
  WorldView view_;
};

/// Computes the estimate of a drone's camera from the truth: a delayed view of the people in its
/// field of view (a cone about the vertical), of whom some are missed and some counted twice. Their
/// destinations are estimated from their motion; whether they follow, from their distance to the
/// beacon.
class CameraPerception {
 public:
  CameraPerception(const world::Scenario& scenario, const PerceptionSpec& spec, std::uint64_t seed,
                   std::size_t drone);

  /// Returns the estimate at the time of `truth`; call it for each step in order.
  const WorldView& estimate(const WorldView& truth);

 private:
  void guess(const WorldView& seen, PersonSeen& person) const;

  const world::Scenario& scenario_;
  PerceptionSpec spec_;
  std::uint64_t seed_;
  std::size_t drone_;
  std::deque<WorldView> past_;
  std::uint64_t looks_ = 0;
  WorldView estimate_;
};

}  // namespace throng::sim
