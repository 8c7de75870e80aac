// Converts the crowd's state to the steps of a trace, and detects events of people.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/people/crowd_source.h"
#include "sim/recording/run_observer.h"
#include "sim/recording/standing_turns.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// Records the crowd of one run.
class CrowdRecorder {
 public:
  /// `moving_goals` are the goals that drones move. All arguments must outlive the recorder.
  CrowdRecorder(const world::Scenario& scenario, const std::vector<world::AgentRole>& roles,
                const std::vector<world::GoalRef>& moving_goals, std::uint64_t seed);

  /// Reports the current state of the crowd, and an event for each agent that has just escaped.
  void record(const CrowdSource& crowd, double time_s, RunObserver& observer);

  /// Per agent: index of the exit for which it heads; -1: none.
  const std::vector<std::int8_t>& intents() const { return intents_; }
  /// Per agent: whether it has escaped.
  const std::vector<bool>& escaped() const { return escaped_; }
  /// Per agent: whether it is in one of the states for lying on the ground (world::TraceHeader).
  const std::vector<bool>& down() const { return down_; }

 private:
  void update_intent(std::size_t agent, const crowd::GoalId& goal, const Eigen::Vector2d& place);
  std::int8_t nearest_exit(const Eigen::Vector2d& place) const;

  const world::Scenario& scenario_;
  const std::vector<world::AgentRole>& roles_;
  const std::vector<world::GoalRef>& moving_goals_;
  std::vector<std::int8_t> intents_;
  std::vector<bool> led_;  ///< follows a drone
  std::vector<bool> was_inside_;
  std::vector<bool> escaped_;
  std::vector<bool> down_;
  std::vector<bool> down_states_;  ///< by index of the state; set by the first record()
  bool turns_people_ = false;      ///< set likewise
  StandingTurns turns_;
};

}  // namespace throng::sim
