// A model of the queues at exits: waiting times, and the time saved by leading people to another
// exit.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/sensors/world_view.h"
#include "world/scenario.h"

namespace throng::sim {

/// Exits as queues with constant service rates. Planned transfers count as if they had happened.
/// Exits are given by index.
class QueueModel {
 public:
  explicit QueueModel(const world::Scenario& scenario);

  /// Estimates the rates from the outflow under demand, and counts the people who head for each
  /// exit. Plans of all drones except `self` count as completed.
  void update(const WorldView& view, int self);

  double capacity_per_s(int exit) const { return capacity_per_s_[index(exit)]; }
  /// The final exit of a person who heads for an exit: at a closed door the person continues to the
  /// nearest open one.
  int ends_up_at(const PersonSeen& person) const;
  /// Time until all people who head for this exit are out; 600 s for a closed exit.
  double wait_s(int exit) const;
  /// Whether the exit was open at the last update.
  bool is_open(int exit) const { return scenario_.exits[index(exit)].is_open(time_s_); }

  /// Person-seconds saved by leading `people` from one queue to another, which they reach in
  /// `arrive_s`; negative for a loss.
  double saving_s(int from, int to, double arrive_s, double people) const;
  /// Person-seconds saved by leading `people` who stand or have not noticed the alarm, and would
  /// otherwise lose `idle_s` each.
  double saving_of_idle_s(double idle_s, int to, double arrive_s, double people) const;

 private:
  /// The index of the nearest open exit.
  std::size_t nearest_exit(const Eigen::Vector2d& place) const;
  void learn_habits(const WorldView& view);
  void expect(const PersonSeen& unaware);
  static std::size_t index(int exit) { return static_cast<std::size_t>(exit); }

  const world::Scenario& scenario_;
  double time_s_ = 0;
  std::vector<double> capacity_per_s_;
  std::vector<double> people_;  // who head for each exit, after planned transfers
  /// [nearest exit][chosen exit]: number of observations, with exponential forgetting.
  std::vector<std::vector<double>> habits_;
};

}  // namespace throng::sim
