// Detects runs whose evacuation metrics are meaningless: people who start outside, are not reached
// by the alarm, or never move.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// The warning about a run without images that ends at `end_s`, before its alarm.
Problem late_alarm(double alarm_s, double end_s);

/// Observes the people of a run and derives warnings.
class PeopleWatch {
 public:
  /// `scenario` must outlive this object. `images_from_s`: time of the first image, if any.
  PeopleWatch(const world::Scenario& scenario, const world::TraceHeader& header,
              std::optional<double> images_from_s);

  /// To be called for each step, in order of time.
  void look(const world::CrowdStep& step);

  /// Whether any person has noticed the alarm, as docs/metrics.md defines it.
  bool anybody_noticed() const { return noticed_ > 0; }

  /// Warnings about the run so far, at most one of each kind, with JSON pointers into a job.
  std::vector<Problem> warnings() const;
  /// The warning, at most one, that people do not notice the alarm, do not head for an exit, or do
  /// not move; only the first of these. Part of warnings().
  std::vector<Problem> idleness() const;

 private:
  struct Person {
    std::size_t agent = 0;
    bool arrived = false;
    bool was_inside = false;
    bool escaped = false;
    bool started = false;  ///< was inside at the alarm or arrived later
    bool noticed = false;
    bool heads_out = false;  ///< since then: for an exit, or follows a guide
    bool moved = false;      ///< since then
    std::int8_t intent_before = -1;
    Eigen::Vector2f start = Eigen::Vector2f::Zero();  ///< m; first position since then
  };

  void look_at(Person& person, const world::CrowdStep& step);
  bool notices(const Person& person, const world::CrowdStep& step) const;
  double start_s() const { return alarm_s_.value_or(0); }
  void add_emptiness(std::vector<Problem>& warnings) const;

  const world::Scenario& scenario_;
  std::optional<double> alarm_s_;
  std::optional<double> images_from_s_;
  bool are_recorded_;
  bool has_aware_states_;
  std::vector<bool> is_aware_;  ///< per state
  std::size_t stand_states_;    ///< the first one of people on stands
  std::vector<Person> people_;
  std::size_t arrived_ = 0;
  std::size_t outside_ = 0;  ///< people who were outside when they arrived
  std::size_t started_ = 0;
  std::size_t noticed_ = 0;
  double time_s_ = 0;
  double last_inside_s_ = 0;  ///< last time at which a person was inside
};

}  // namespace throng::sim
