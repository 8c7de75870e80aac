// Each person of a run: when they arrived, noticed the alarm and escaped. The one definition of who
// counts and from when, for metrics of a trace and for studies, which see a run as it goes.
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
  double time_s = 0;  ///< on the line
};

struct PersonRecord {
  std::size_t agent = 0;
  std::size_t first_step = 0;  ///< the first one at which the person takes part
  double arrived_s = 0;        ///< first inside; of somebody who never is: first present
  double start_s = 0;          ///< the later of alarm and arrival, from which escape counts
  bool was_inside = false;     ///< at any time; others take no part in the evacuation
  Eigen::Vector2d start_place = Eigen::Vector2d::Zero();  ///< at the first step from then on
  std::optional<double> noticed_s;                        ///< knows of the alarm; never before it
  Eigen::Vector2d noticed_place = Eigen::Vector2d::Zero();
  /// First outside of Scenario::inside after having been inside, or gone for good behind a door.
  std::optional<double> escaped_s;
  std::optional<std::size_t> left_by;  ///< the exit of the escape; empty: it led through no exit
  bool turned_back = false;            ///< arrived outside of the exits and did not come in
  std::optional<double> vanished_s;    ///< gone for good inside, where a recording of them ends
  std::optional<double> hurt_s;        ///< lies from then on in a state for that, to the end
  double followed_s = 0;               ///< time in states whose name contains "follow"
  double followed_m = 0;               ///< distance walked in them
  double max_desired_mps = 0;          ///< greatest desired speed before the escape
  /// Greatest speed from `start_s` to the escape: of the trace's velocities, desired speeds and
  /// displacements per step, which physical contact can make the greatest of the three.
  double max_speed_mps = 0;
  std::optional<DoorPassage> last_out;  ///< before the escape, from `start_s` on

  /// Whether the person left before there was anything to escape from.
  bool left_before_alarm() const { return escaped_s && *escaped_s < start_s - world::kTimeSlackS; }
  /// Whether the person's escape is measured.
  bool is_evacuee() const { return was_inside && !left_before_alarm(); }
  /// Whether there is nothing more to be seen of the person.
  bool has_ended() const { return escaped_s || vanished_s; }
};

/// Everybody at one step, as a trace or a running simulation has it; one entry per agent.
struct PeopleStep {
  double time_s = 0;
  std::span<const Eigen::Vector2f> position;
  std::span<const Eigen::Vector2f> velocity;
  std::span<const float> desired_speed_mps;
  std::span<const std::uint8_t> state;
  std::span<const std::int8_t> exit_intent;
  std::span<const std::uint8_t> flags;
};

/// How many went through a door in either direction.
struct DoorCounts {
  int out = 0;
  int in = 0;
};

/// Mean radius of all people of the header, present or not (m); 0 without any.
double mean_radius_m(const world::TraceHeader& header);

/// Greatest radius of all people of the header (m); 0 without any.
double max_radius_m(const world::TraceHeader& header);

/// Watches people step by step. The scenario outlives it.
///
/// Noticing: the first step, from the later of alarm and arrival on, at which somebody is in a
/// state of people who know (world::Alarm::aware_states). If the behavior does not define those
/// states, the first such step at which somebody follows a guide or heads for an exit that they did
/// not head for before the alarm. Without an alarm nobody notices anything.
class PeopleTracker {
 public:
  PeopleTracker(const world::TraceHeader& header, const world::Scenario& scenario,
                world::Alarm alarm);

  /// Steps come in order of time.
  void step(const PeopleStep& step);

  /// Everybody who has taken part so far, by number of the agent.
  std::vector<PersonRecord> records() const;
  /// Whether everybody of the header has arrived and escaped, or vanished.
  bool all_escaped() const;
  double time_s() const { return time_s_; }  ///< of the last step

 private:
  struct Person {
    PersonRecord record;
    bool seen = false;
    bool started = false;
    bool present_before = false;
    Eigen::Vector2d last_place = Eigen::Vector2d::Zero();
    std::int8_t intent_before_alarm = -1;
    std::vector<CrossingCounter> counters;  ///< per exit
    /// The person arrived beyond the line of the nearest exit, and has always been beyond that of
    /// the nearest one since: they have not come in.
    bool is_before_doors = false;
  };

  void arrive(Person& person, const PeopleStep& step);
  std::optional<std::size_t> nearest_exit_if_beyond(const Eigen::Vector2d& place) const;
  void follow(Person& person, const PeopleStep& step, bool present);
  std::optional<std::size_t> exit_of_escape(const Person& person,
                                            const Eigen::Vector2d& place) const;
  void add_motion(Person& person, const PeopleStep& step);
  bool notices(const Person& person, const PeopleStep& step) const;
  void count_doors(Person& person, const PeopleStep& step, bool present);

  const world::Scenario& scenario_;
  world::Alarm alarm_;
  double dt_s_;
  bool is_recorded_;
  std::vector<bool> follows_, is_down_, is_aware_;  ///< per state of the header
  std::vector<ExitLine> lines_;
  std::vector<Person> people_;
  std::size_t steps_ = 0;
  double time_s_ = 0;
};

/// A tracker that has seen a whole trace.
PeopleTracker tracked(const world::Trace& trace, const world::Scenario& scenario,
                      const world::Alarm& alarm);

/// The same, of which only the people matter.
std::vector<PersonRecord> person_records(const world::Trace& trace, const world::Scenario& scenario,
                                         const world::Alarm& alarm);

}  // namespace throng::metrics
