// Perception of drones: the truth of a run, and the estimate of a camera that counts people.
#pragma once

#include <deque>
#include <vector>

#include "sim/people/crowd_source.h"
#include "sim/recording/crowd_recorder.h"
#include "sim/sensors/world_view.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// The true view. It excludes people who have escaped, are absent, injured or a hazard, and those
/// who have passed a door, unless a drone still leads them.
class CrowdObserver {
 public:
  /// `guide_goals`: per drone, the goal that it moves, if any. All must outlive the lookout.
  CrowdObserver(const world::Scenario& scenario, const std::vector<world::AgentRole>& roles,
                const std::vector<std::optional<world::GoalRef>>& guide_goals, double step_s);

  /// Looks at the crowd as it is now. The drones in the view are the caller's to fill in.
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
  std::vector<bool> left_;              ///< per agent: has gone through a door
  std::deque<std::vector<int>> out_;    ///< per step of the last seconds, per exit: who went out
  std::size_t flow_steps_;              ///< how many of those
  double step_s_;
  WorldView view_;
};

/// Report of a drone's camera, derived from the truth: only people in its field of view (a cone
/// about the vertical), some missed and some counted twice, as of a while ago. Their destinations
/// are estimated from their motion, and whether they follow from their distance to the beacon.
class CameraPerception {
 public:
  CameraPerception(const world::Scenario& scenario, const PerceptionSpec& spec, std::uint64_t seed,
                   std::size_t drone);

  /// The estimate at the time of `truth`, which must come step by step.
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
