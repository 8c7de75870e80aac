#include "metrics/basis/people.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <string>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/text/words.h"
#include "metrics/basis/walking_distance.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

// A state without a name in the header has none of the properties that follow from names.
bool holds(const std::vector<bool>& states, std::uint8_t state) {
  return state < states.size() && states[state];
}

/// Whether no building stands between two points. One that covers the second, as behind a door
/// drawn on its wall, is none between them.
bool is_in_sight(const Vector2d& from, const Vector2d& to,
                 const std::vector<world::Building>& buildings) {
  return std::none_of(buildings.begin(), buildings.end(), [&](const world::Building& building) {
    return geometry::distance_to(building.footprint, to) > 0 &&
           crosses_outline(building.footprint, from, to);
  });
}

}  // namespace

double mean_radius_m(const world::TraceHeader& header) {
  double sum_m = 0;
  int people = 0;
  for (std::size_t agent = 0; agent < header.agent_count(); ++agent) {
    if (header.role[agent] != world::AgentRole::person) continue;
    sum_m += header.radius_m[agent];
    ++people;
  }
  return people == 0 ? 0.0 : sum_m / people;
}

double max_radius_m(const world::TraceHeader& header) {
  double max_m = 0;
  for (std::size_t agent = 0; agent < header.agent_count(); ++agent) {
    if (header.role[agent] != world::AgentRole::person) continue;
    max_m = std::max(max_m, static_cast<double>(header.radius_m[agent]));
  }
  return max_m;
}

PeopleTracker::PeopleTracker(const world::TraceHeader& header, const world::Scenario& scenario,
                             world::Alarm alarm)
    : scenario_(scenario),
      alarm_(std::move(alarm)),
      dt_s_(header.dt_s),
      is_recorded_(header.crowd.model == world::kRecordedCrowd),
      stand_states_(header.first_stand_state().value_or(std::numeric_limits<std::size_t>::max())) {
  for (const std::string& name : header.state_names) {
    const auto& aware = alarm_.aware_states;
    follows_.push_back(lower_case(name).find("follow") != std::string::npos);
    is_aware_.push_back(std::find(aware.begin(), aware.end(), name) != aware.end());
  }
  is_down_ = header.lying_states();
  lines_ = exit_lines(scenario.exits, mean_radius_m(header));
  for (std::size_t agent = 0; agent < header.agent_count(); ++agent) {
    if (header.role[agent] != world::AgentRole::person) continue;
    Person& person = people_.emplace_back();
    person.record.agent = agent;
    person.counters.resize(lines_.size());
  }
}

void PeopleTracker::step(const PeopleStep& step) {
  time_s_ = step.time_s;
  for (Person& person : people_) {
    const std::size_t agent = person.record.agent;
    const bool present =
        (step.flags[agent] & world::kPresent) != 0 && step.state[agent] < stand_states_;
    if (present) arrive(person, step);
    if (!person.seen) continue;
    if (present || person.present_before) count_doors(person, step, present);
    if (present && is_in(person, place_of(person, step))) {
      observe(person, step);
    } else if (person.record.came_to_exit) {
      leave(person, step, present);
    }
    if (present) person.last_place = step.position[person.record.agent].cast<double>();
    person.present_before = present;
  }
  ++steps_;
}

Vector2d PeopleTracker::place_of(const Person& person, const PeopleStep& step) {
  return step.position[person.record.agent].cast<double>();
}

bool PeopleTracker::all_escaped() const {
  return std::all_of(people_.begin(), people_.end(),
                     [](const Person& person) { return person.is_settled; });
}

void PeopleTracker::arrive(Person& person, const PeopleStep& step) {
  PersonRecord& record = person.record;
  const Vector2d place = place_of(person, step);
  const bool is_in_bounds = scenario_.inside.contains(place);
  if (is_in_bounds && !record.was_inside) {
    // People who come from outside must cross the line; touching it is not enough.
    record.was_inside = !is_at_an_exit(place, person.seen ? CrossingCounter::kHysteresisM : 0);
  }
  if (person.seen && (record.came_to_exit || !is_in_bounds)) return;
  person.seen = true;
  record.came_to_exit = is_in_bounds;
  record.first_step = steps_;
  record.arrived_s = step.time_s;
  record.start_s = std::max(alarm_.at_s.value_or(step.time_s), step.time_s);
}

/// Whether a place lies less than `margin_m` on the inner side of the line of the nearest exit, or
/// beyond it, with no building between the place and the ground behind the exit.
bool PeopleTracker::is_at_an_exit(const Vector2d& place, double margin_m) const {
  const auto distance_m = [&](const world::Exit& exit) {
    return geometry::distance_to_segment(exit.from, exit.to, place);
  };
  const auto& exits = scenario_.exits;
  const auto nearest = std::min_element(
      exits.begin(), exits.end(),
      [&](const auto& one, const auto& other) { return distance_m(one) < distance_m(other); });
  if (nearest == exits.end()) return false;
  const ExitLine& line = lines_[static_cast<std::size_t>(nearest - exits.begin())];
  if (line.beyond_m(place) < -margin_m) return false;
  const std::array ends = {nearest->from, nearest->middle(), nearest->to};
  constexpr double kBehindM = 1;
  return std::any_of(ends.begin(), ends.end(), [&](const Vector2d& end) {
    return is_in_sight(place, end + kBehindM * nearest->outward, scenario_.buildings);
  });
}

/// Whether the person is in Scenario::inside, or between its border and an exit not yet passed.
bool PeopleTracker::is_in(const Person& person, const Vector2d& place) const {
  if (scenario_.inside.contains(place)) return true;
  if (!person.record.came_to_exit || passed_exit(person)) return false;
  return std::any_of(lines_.begin(), lines_.end(),
                     [&](const ExitLine& line) { return line.is_just_before(place); });
}

/// The exit whose line the person passed last, if the person has not come back through it.
std::optional<std::size_t> PeopleTracker::passed_exit(const Person& person) const {
  std::optional<std::size_t> passed;
  for (std::size_t e = 0; e < lines_.size(); ++e) {
    const CrossingCounter& counter = person.counters[e];
    if (!counter.has_left()) continue;
    if (!passed || counter.crossed_at_s() > person.counters[*passed].crossed_at_s()) passed = e;
  }
  return passed;
}

/// The exit in whose doorway a place lies.
std::optional<std::size_t> PeopleTracker::exit_at(const Vector2d& place) const {
  for (std::size_t e = 0; e < lines_.size(); ++e) {
    if (lines_[e].is_in_doorway(place)) return e;
  }
  return std::nullopt;
}

/// A step outside, or absent.
void PeopleTracker::leave(Person& person, const PeopleStep& step, bool present) {
  if (person.is_settled) return;
  PersonRecord& record = person.record;
  if (present) add_motion(person, step);
  const Vector2d place = present ? place_of(person, step) : person.last_place;
  const std::optional<std::size_t> passed = passed_exit(person);
  // Recordings end anywhere; the crowd removes people at doors.
  const bool may_end_anywhere = is_recorded_ && scenario_.inside.contains(place);
  const std::optional<std::size_t> exit = passed || may_end_anywhere ? passed : exit_at(place);
  person.is_settled = passed || !present;
  if (!record.was_inside) {
    if (!may_end_anywhere && !record.turned_back_s) record.turned_back_s = step.time_s;
    return;
  }
  // Beyond the border without having passed an exit, the person may still come to one.
  const bool comes_to_exit = person.is_settled && exit;
  if (!record.escaped_s ? present || exit : comes_to_exit) {
    // A person who is absent behind an exit was out before.
    record.escaped_s = passed ? step.time_s : record.escaped_s.value_or(step.time_s);
    record.left_by = exit;
    record.hurt_s.reset();
  } else if (!record.escaped_s && !record.vanished_s) {
    record.vanished_s = step.time_s;
  }
}

/// A step inside.
void PeopleTracker::observe(Person& person, const PeopleStep& step) {
  PersonRecord& record = person.record;
  person.is_settled = false;
  record.escaped_s.reset();
  record.left_by.reset();
  record.turned_back_s.reset();
  record.vanished_s.reset();
  const Vector2d place = place_of(person, step);
  const bool has_started = step.time_s >= record.start_s - world::kTimeSlackS;
  if (has_started && !person.started) {
    person.started = true;
    record.start_place = place;
  }
  add_motion(person, step);
  const std::uint8_t state = step.state[record.agent];
  if (!holds(is_down_, state)) {
    record.hurt_s.reset();
  } else if (!record.hurt_s) {
    record.hurt_s = step.time_s;
  }
  if (!has_started) {
    person.intent_before_alarm = step.exit_intent[record.agent];
  } else if (!record.noticed_s && notices(person, step)) {
    record.noticed_s = step.time_s;
    record.noticed_place = place;
  }
  if (!holds(follows_, state)) return;
  record.followed_s += dt_s_;
  if (person.present_before) record.followed_m += (place - person.last_place).norm();
}

void PeopleTracker::add_motion(Person& person, const PeopleStep& step) {
  PersonRecord& record = person.record;
  const double desired_mps = step.desired_speed_mps[record.agent];
  record.max_desired_mps = std::max(record.max_desired_mps, desired_mps);
  if (!person.started) return;
  const double velocity_mps = step.velocity[record.agent].cast<double>().norm();
  record.max_speed_mps = std::max({record.max_speed_mps, desired_mps, velocity_mps});
  // Displacements count from the start's place on.
  if (!person.present_before || step.time_s < record.start_s + 0.5 * dt_s_) return;
  const Vector2d place = step.position[record.agent].cast<double>();
  record.max_speed_mps = std::max(record.max_speed_mps, (place - person.last_place).norm() / dt_s_);
}

bool PeopleTracker::notices(const Person& person, const PeopleStep& step) const {
  if (!alarm_.at_s) return false;
  const std::uint8_t state = step.state[person.record.agent];
  if (!alarm_.aware_states.empty()) return holds(is_aware_, state);
  const std::int8_t intent = step.exit_intent[person.record.agent];
  return holds(follows_, state) || (intent >= 0 && intent != person.intent_before_alarm);
}

void PeopleTracker::count_doors(Person& person, const PeopleStep& step, bool present) {
  PersonRecord& record = person.record;
  const Vector2d place = step.position[record.agent].cast<double>();
  const bool is_outside = !scenario_.inside.contains(place);
  for (std::size_t e = 0; e < lines_.size(); ++e) {
    CrossingCounter& counter = person.counters[e];
    const int crossing =
        present ? counter.step(lines_[e], place, step.time_s, is_outside) : counter.vanish();
    if (crossing == 0) continue;
    const double crossed_s = counter.crossed_at_s();
    // A crossing is known 0.2 m beyond the line only, by when the person may have escaped.
    const bool before_escape = !person.is_settled || crossed_s <= record.escaped_s.value_or(0);
    if (crossing < 0 || crossed_s < record.start_s || !before_escape) continue;
    if (!record.last_out || crossed_s > record.last_out->time_s) {
      record.last_out = DoorPassage{e, crossed_s};
    }
  }
}

std::vector<PersonRecord> PeopleTracker::records() const {
  std::vector<PersonRecord> records;
  for (const Person& person : people_) {
    if (person.seen) records.push_back(person.record);
  }
  return records;
}

PeopleTracker tracked(const world::Trace& trace, const world::Scenario& scenario,
                      const world::Alarm& alarm) {
  PeopleTracker tracker(trace.header, scenario, alarm);
  const std::size_t agents = trace.agents();
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    const auto row = [&](const auto& values) {
      return std::span(values).subspan(step * agents, agents);
    };
    tracker.step({trace.time_s[step], row(trace.position), row(trace.velocity),
                  row(trace.desired_speed_mps), row(trace.state), row(trace.exit_intent),
                  row(trace.flags)});
  }
  return tracker;
}

std::vector<PersonRecord> person_records(const world::Trace& trace, const world::Scenario& scenario,
                                         const world::Alarm& alarm) {
  return tracked(trace, scenario, alarm).records();
}

}  // namespace throng::metrics
