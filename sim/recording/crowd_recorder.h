// Turns the crowd's state into a run's steps, and notices what happens to people.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/people/crowd_source.h"
#include "sim/run_observer.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

class CrowdRecorder {
 public:
  /// `moving_goals` are the goals that drones move. All three must outlive the recorder.
  CrowdRecorder(const world::Scenario& scenario, const std::vector<world::AgentRole>& roles,
                const std::vector<world::GoalRef>& moving_goals);

  /// Reports the crowd as it is now, and an event for everybody who has got away just now.
  void record(const CrowdSource& crowd, double time_s, RunObserver& observer);

  /// Per agent: index of the exit that it heads for; -1: none.
  const std::vector<std::int8_t>& intents() const { return intents_; }
  /// Per agent: whether it has got away.
  const std::vector<bool>& escaped() const { return escaped_; }
  /// Per agent: whether it lies there, in a state for that (world::TraceHeader).
  const std::vector<bool>& down() const { return down_; }

 private:
  void update_intent(std::size_t agent, const crowd::GoalId& goal, const Eigen::Vector2d& place);
  std::int8_t nearest_exit(const Eigen::Vector2d& place) const;

  const world::Scenario& scenario_;
  const std::vector<world::AgentRole>& roles_;
  const std::vector<world::GoalRef>& moving_goals_;
  std::vector<std::int8_t> intents_;
  std::vector<bool> led_;  ///< follows a drone
  std::vector<bool> arrived_;
  std::vector<bool> escaped_;
  std::vector<bool> down_;
  std::vector<bool> down_states_;  ///< by number of the state, from the first record on
};

}  // namespace throng::sim
