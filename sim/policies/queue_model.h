// How long people will wait at each exit, and what it would save to lead some of them elsewhere.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/sensors/world_view.h"
#include "world/scenario.h"

namespace throng::sim {

/// Exits as queues that are served at a steady rate. Planned transfers count as if they had
/// happened.
class QueueModel {
 public:
  explicit QueueModel(const world::Scenario& scenario);

  /// Learns the rates from what flows out while people press, and counts who wants which exit;
  /// the plans of all drones but `self` are taken for done.
  void update(const WorldView& view, int self);

  double capacity_per_s(int exit) const { return capacity_per_s_[index(exit)]; }
  /// Final exit of an informed person: a closed door is discovered on arrival, and the person
  /// continues to the nearest open one.
  int ends_up_at(const PersonSeen& person) const;
  /// Time until everybody who wants this exit is out; far more than any run for a closed one.
  double wait_s(int exit) const;
  /// Whether people can get out there as of the last update.
  bool is_open(int exit) const { return scenario_.exits[index(exit)].is_open(time_s_); }

  /// Total savings (person-seconds) of leading `people` from one queue to another, which they reach
  /// in `arrive_s`; negative when it costs.
  double saving_s(int from, int to, double arrive_s, double people) const;
  /// The same for people who have not noticed or are standing, and would lose `idle_s` each.
  double saving_of_idle_s(double idle_s, int to, double arrive_s, double people) const;

 private:
  /// The index of the nearest exit that is open.
  std::size_t nearest_exit(const Eigen::Vector2d& place) const;
  void learn_habits(const WorldView& view);
  void expect(const PersonSeen& unaware);
  static std::size_t index(int exit) { return static_cast<std::size_t>(exit); }

  const world::Scenario& scenario_;
  double time_s_ = 0;
  std::vector<double> capacity_per_s_;
  std::vector<double> people_;  // who want each exit, with what is planned
  /// [nearest exit][exit that is chosen there]: looks at people, the latest counting most.
  std::vector<std::vector<double>> habits_;
};

}  // namespace throng::sim
