#include "metrics/basis/people.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/text/words.h"

namespace throng::metrics {

using Eigen::Vector2d;

namespace {

// A state without a name in the header has none of the properties that follow from names.
bool holds(const std::vector<bool>& states, std::uint8_t state) {
  return state < states.size() && states[state];
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
      is_recorded_(header.crowd.model == world::kRecordedCrowd) {
  for (const std::string& name : header.state_names) {
    const auto& aware = alarm_.aware_states;
    follows_.push_back(lower_case(name).find("follow") != std::string::npos);
    is_aware_.push_back(std::find(aware.begin(), aware.end(), name) != aware.end());
  }
  is_down_ = header.lying_states();
  const double margin_m = mean_radius_m(header);
  for (const world::Exit& exit : scenario.exits) lines_.emplace_back(exit, margin_m);
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
    const bool present = (step.flags[person.record.agent] & world::kPresent) != 0;
    if (present) arrive(person, step);
    if (!person.seen) continue;
    if (present || person.present_before) count_doors(person, step, present);
    if (person.record.was_inside && !person.record.escaped_s) follow(person, step, present);
    if (present) person.last_place = step.position[person.record.agent].cast<double>();
    person.present_before = present;
  }
  ++steps_;
}

bool PeopleTracker::all_escaped() const {
  return std::all_of(people_.begin(), people_.end(),
                     [](const Person& person) { return person.record.has_ended() && person.seen; });
}

void PeopleTracker::arrive(Person& person, const PeopleStep& step) {
  PersonRecord& record = person.record;
  const bool is_inside = scenario_.inside.contains(step.position[record.agent].cast<double>());
  if (person.seen && (record.was_inside || !is_inside)) return;
  person.seen = true;
  record.was_inside = is_inside;
  record.first_step = steps_;
  record.arrived_s = step.time_s;
  record.start_s = std::max(alarm_.at_s.value_or(step.time_s), step.time_s);
  person.is_before_doors = true;
}

std::optional<std::size_t> PeopleTracker::nearest_exit_if_beyond(const Vector2d& place) const {
  std::optional<std::size_t> nearest;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < scenario_.exits.size(); ++e) {
    const world::Exit& exit = scenario_.exits[e];
    const double distance_m = geometry::distance_to_segment(exit.from, exit.to, place);
    if (distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    nearest = e;
  }
  if (nearest && lines_[*nearest].beyond_m(place) < 0) return std::nullopt;
  return nearest;
}

std::optional<std::size_t> PeopleTracker::exit_of_escape(const Person& person,
                                                         const Vector2d& place) const {
  std::optional<std::size_t> passed;
  for (std::size_t e = 0; e < lines_.size(); ++e) {
    const CrossingCounter& counter = person.counters[e];
    if (!counter.has_left()) continue;
    if (!passed || counter.crossed_at_s() > person.counters[*passed].crossed_at_s()) passed = e;
  }
  if (passed) return passed;
  if (person.is_before_doors) return nearest_exit_if_beyond(place);
  // Recordings end anywhere; the crowd removes people at doors.
  if (is_recorded_ && scenario_.inside.contains(place)) return std::nullopt;
  // The place, or a person's way, ends before the line of the door.
  for (std::size_t e = 0; e < lines_.size(); ++e) {
    if (lines_[e].is_in_doorway(place)) return e;
  }
  return std::nullopt;
}

void PeopleTracker::follow(Person& person, const PeopleStep& step, bool present) {
  PersonRecord& record = person.record;
  const Vector2d place = step.position[record.agent].cast<double>();
  const bool has_started = step.time_s >= record.start_s - world::kTimeSlackS;
  if (present && has_started && !person.started) {
    person.started = true;
    record.start_place = place;
  }
  if (present) add_motion(person, step);
  if (!present || !scenario_.inside.contains(place)) {
    record.left_by = exit_of_escape(person, present ? place : person.last_place);
    if (present || record.left_by) {
      record.escaped_s = step.time_s;
      record.turned_back = record.left_by && person.is_before_doors;
      record.hurt_s.reset();
    } else if (!record.vanished_s) {
      record.vanished_s = step.time_s;
    }
    return;
  }
  record.vanished_s.reset();
  person.is_before_doors = person.is_before_doors && nearest_exit_if_beyond(place);
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
    const bool before_escape = !record.escaped_s || crossed_s <= *record.escaped_s;
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
