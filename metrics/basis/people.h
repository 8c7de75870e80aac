// Detects when each person of a run arrived, noticed the alarm and escaped. These definitions are
// common to the metrics of a trace and to studies, which observe a running simulation.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "metrics/basis/crossings.h"
#include "world/alarm.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// A person's last passage out through a door.
struct DoorPassage {
  std::size_t exit = 0;
  double time_s = 0;  ///< time on the door's line
};

/// The history of a person in a run.
struct PersonRecord {
  std::size_t agent = 0;
  std::size_t first_step = 0;  ///< first step at which the person is present
  double arrived_s = 0;        ///< first time in Scenario::inside; if never, first time present
  double start_s = 0;          ///< the later of alarm and arrival, start of the escape time
  /// Whether the person has been in the place: in Scenario::inside, and not just beyond the line of
  /// the exit at which the person arrived. Other people are no evacuees.
  bool was_inside = false;
  bool came_to_exit = false;  ///< in Scenario::inside at any time, even if only beyond an exit
  Eigen::Vector2d start_place = Eigen::Vector2d::Zero();  ///< at the first step from start_s on, m
  std::optional<double> noticed_s;                        ///< when the person noticed the alarm
  Eigen::Vector2d noticed_place = Eigen::Vector2d::Zero();
  /// The time from which on the person was out for good: outside of Scenario::inside and past the
  /// line of an exit if the person passed one, or absent behind an exit.
  std::optional<double> escaped_s;
  std::optional<std::size_t> left_by;  ///< exit of the escape; nothing: not through an exit
  /// When a person who had arrived at an exit and had not entered left Scenario::inside for good.
  std::optional<double> turned_back_s;
  /// Absent for good although inside, as at the end of a recording.
  std::optional<double> vanished_s;
  std::optional<double> hurt_s;  ///< start of the casualty state that lasts until the end
  double followed_s = 0;         ///< time in states whose names contain "follow"
  double followed_m = 0;         ///< distance walked in these states
  double max_desired_mps = 0;    ///< max desired speed before the escape
  /// Max speed from `start_s` to the escape, over the trace's velocities, desired speeds and
  /// displacements per step (which physical contact can make the largest of the three).
  double max_speed_mps = 0;
  std::optional<DoorPassage> last_out;  ///< last passage outward from `start_s` to the escape

  /// Whether the person left before the alarm.
  bool left_before_alarm() const { return escaped_s && *escaped_s < start_s - world::kTimeSlackS; }
  /// Whether the person's escape is measured.
  bool is_evacuee() const { return was_inside && !left_before_alarm(); }
};

/// The state of all agents at one step, from a trace or a running simulation. Spans have one
/// element per agent.
struct PeopleStep {
  double time_s = 0;
  std::span<const Eigen::Vector2f> position;
  std::span<const Eigen::Vector2f> velocity;
  std::span<const float> desired_speed_mps;
  std::span<const std::uint8_t> state;
  std::span<const std::int8_t> exit_intent;
  std::span<const std::uint8_t> flags;
};

/// Numbers of crossings of a door in both directions.
struct DoorCounts {
  int out = 0;
  int in = 0;
};

/// Mean radius (m) of all people of the header, present or not; 0 without people.
double mean_radius_m(const world::TraceHeader& header);

/// Max radius (m) of all people of the header; 0 without people.
double max_radius_m(const world::TraceHeader& header);

/// Observes people step by step. The scenario must outlive the tracker.
///
/// A person notices the alarm at the first step, from the later of alarm and arrival on, in a state
/// of people who are aware of it (world::Alarm::aware_states). If the behavior does not define such
/// states, it is the first step at which the person follows a guide or heads for an exit that the
/// person did not head for before the alarm. Without an alarm nobody notices.
class PeopleTracker {
 public:
  PeopleTracker(const world::TraceHeader& header, const world::Scenario& scenario,
                world::Alarm alarm);

  /// To be called for each step, in order of time.
  void step(const PeopleStep& step);

  /// The records of all people who have been present so far, in the order of agents.
  std::vector<PersonRecord> records() const;
  /// Whether all people of the header have arrived, and have left by an exit or are absent.
  bool all_escaped() const;
  double time_s() const { return time_s_; }  ///< time of the last step

 private:
  struct Person {
    PersonRecord record;
    bool seen = false;
    bool is_settled = false;  ///< has left by an exit or is absent, and has not come back
    bool started = false;
    bool present_before = false;
    Eigen::Vector2d last_place = Eigen::Vector2d::Zero();
    std::int8_t intent_before_alarm = -1;
    std::vector<CrossingCounter> counters;  ///< per exit
  };

  static Eigen::Vector2d place_of(const Person& person, const PeopleStep& step);
  void arrive(Person& person, const PeopleStep& step);
  bool is_in(const Person& person, const Eigen::Vector2d& place) const;
  bool is_at_an_exit(const Eigen::Vector2d& place, double margin_m) const;
  void observe(Person& person, const PeopleStep& step);
  void leave(Person& person, const PeopleStep& step, bool present);
  std::optional<std::size_t> passed_exit(const Person& person) const;
  std::optional<std::size_t> exit_at(const Eigen::Vector2d& place) const;
  void add_motion(Person& person, const PeopleStep& step);
  bool notices(const Person& person, const PeopleStep& step) const;
  void count_doors(Person& person, const PeopleStep& step, bool present);

  const world::Scenario& scenario_;
  world::Alarm alarm_;
  double dt_s_;
  bool is_recorded_;
  std::size_t stand_states_;  ///< the first state of people on stands, who have not come yet
  std::vector<bool> follows_, is_down_, is_aware_;  ///< per state of the header
  std::vector<ExitLine> lines_;
  std::vector<Person> people_;
  std::size_t steps_ = 0;
  double time_s_ = 0;
};

/// A tracker that has observed a whole trace.
PeopleTracker tracked(const world::Trace& trace, const world::Scenario& scenario,
                      const world::Alarm& alarm);

/// The records() of a whole trace.
std::vector<PersonRecord> person_records(const world::Trace& trace, const world::Scenario& scenario,
                                         const world::Alarm& alarm);

}  // namespace throng::metrics
