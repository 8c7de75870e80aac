#include "sim/people/people_watch.h"
#include "base/text/words.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace throng::sim {

namespace {

constexpr double kHardly = 0.05;   // share of the people
constexpr double kPatienceS = 10;  // a run that ends sooner after the alarm says nothing
constexpr float kMovedM = 1;       // more than shuffling on the spot
constexpr const char* kScenario = "/scenario";

std::string share_text(std::size_t some, std::size_t all) {
  return some == 0 ? "none of " + counted(static_cast<std::int64_t>(all), "person", "people")
                   : fmt::format("only {} of {}", some,
                                 counted(static_cast<std::int64_t>(all), "person", "people"));
}

bool is_hardly_any(std::size_t some, std::size_t all) {
  return static_cast<double>(some) <= kHardly * static_cast<double>(all);
}

}  // namespace

Problem late_alarm(double alarm_s, double end_s) {
  return {"", "/capture/to_s",
          fmt::format("an end at {:.4g} s, before the alarm at {:.4g} s", end_s, alarm_s),
          "a longer run: nobody can escape from a disaster that is yet to come"};
}

PeopleWatch::PeopleWatch(const world::Scenario& scenario, const world::TraceHeader& header,
                         std::optional<double> images_from_s)
    : scenario_(scenario),
      alarm_s_(header.alarm ? header.alarm->at_s : std::nullopt),
      images_from_s_(images_from_s),
      are_recorded_(header.crowd.model == world::kRecordedCrowd),
      has_aware_states_(header.alarm && !header.alarm->aware_states.empty()),
      stand_states_(header.first_stand_state().value_or(std::numeric_limits<std::size_t>::max())) {
  for (const std::string& state : header.state_names) {
    is_aware_.push_back(has_aware_states_ &&
                        std::count(header.alarm->aware_states.begin(),
                                   header.alarm->aware_states.end(), state) > 0);
  }
  for (std::size_t agent = 0; agent < header.agent_count(); ++agent) {
    if (header.role[agent] == world::AgentRole::person) people_.push_back({.agent = agent});
  }
}

void PeopleWatch::look(const world::CrowdStep& step) {
  time_s_ = step.time_s;
  for (Person& person : people_) {
    if (!person.escaped) look_at(person, step);
  }
}

void PeopleWatch::look_at(Person& person, const world::CrowdStep& step) {
  const bool is_present = (step.flags[person.agent] & world::kPresent) != 0;
  if (!is_present && !person.arrived) return;
  // People on a stand have not come yet.
  if (is_present && !step.state.empty() && step.state[person.agent] >= stand_states_) return;
  const Eigen::Vector2f& place = step.position[person.agent];
  const bool is_inside = is_present && scenario_.inside.contains(place.cast<double>());
  if (!person.arrived) {
    person.arrived = true;
    ++arrived_;
    outside_ += is_inside ? 0 : 1;
  }
  if (!is_inside) {
    person.escaped = person.was_inside;
    return;
  }
  person.was_inside = true;
  last_inside_s_ = step.time_s;
  const std::int8_t intent = step.exit_intent[person.agent];
  if (step.time_s < start_s() - world::kTimeSlackS) {
    person.intent_before = intent;
    return;
  }
  if (!person.started) {
    person.started = true;
    person.start = place;
    ++started_;
  }
  const bool follows = (step.flags[person.agent] & world::kFollowing) != 0;
  person.heads_out = person.heads_out || intent >= 0 || follows;
  person.moved = person.moved || (place - person.start).norm() > kMovedM;
  if (person.noticed || !notices(person, step)) return;
  person.noticed = true;
  ++noticed_;
}

bool PeopleWatch::notices(const Person& person, const world::CrowdStep& step) const {
  if (!alarm_s_) return false;
  if (has_aware_states_) return is_aware_[step.state[person.agent]];
  const std::int8_t intent = step.exit_intent[person.agent];
  return (step.flags[person.agent] & world::kFollowing) != 0 ||
         (intent >= 0 && intent != person.intent_before);
}

std::vector<Problem> PeopleWatch::idleness() const {
  if (are_recorded_ || started_ == 0 || time_s_ < start_s() + kPatienceS) return {};
  const auto count = [&](bool Person::*what) {
    return static_cast<std::size_t>(
        std::count_if(people_.begin(), people_.end(), [&](const Person& p) { return p.*what; }));
  };
  if (alarm_s_ && is_hardly_any(noticed_, started_)) {
    return {{"", kScenario,
             fmt::format("an alarm at {:.4g} s that {} noticed until {:.4g} s", *alarm_s_,
                         share_text(noticed_, started_), time_s_),
             scenario_.built_crowd
                 ? "a disaster within whose \"noticed_m\" people are"
                 : "a disaster within whose reach people are, a behavior in which they notice it, "
                   "and the \"crowd.compat\" that its files were made for"}};
  }
  if (const std::size_t out = count(&Person::heads_out); alarm_s_ && is_hardly_any(out, started_)) {
    return {{"", kScenario,
             fmt::format("{} who head for an exit or follow a guide after the alarm at {:.4g} s, "
                         "until {:.4g} s",
                         share_text(out, started_), *alarm_s_, time_s_),
             scenario_.built_crowd
                 ? "an open exit that people can reach"
                 : "a behavior in which people who know of the alarm choose a goal of an exit "
                   "(\"exits[].goals\" of the scenario)"}};
  }
  const std::size_t moving = count(&Person::moved);
  if (moving == 0 || (alarm_s_ && is_hardly_any(moving, started_))) {
    return {{"", kScenario,
             fmt::format("{} who move by more than {} m from {:.4g} s to {:.4g} s",
                         share_text(moving, started_), kMovedM, start_s(), time_s_),
             "people who walk, or a run without figures of evacuation"}};
  }
  return {};
}

void PeopleWatch::add_emptiness(std::vector<Problem>& warnings) const {
  const bool are_all_gone = std::all_of(people_.begin(), people_.end(),
                                        [](const Person& p) { return !p.was_inside || p.escaped; });
  if (arrived_ > 0 && are_all_gone && images_from_s_ && last_inside_s_ < *images_from_s_) {
    warnings.push_back(
        {"", "/capture/from_s",
         fmt::format("images from {:.4g} s on, when everybody has left (at {:.4g} s)",
                     *images_from_s_, last_inside_s_),
         "a time at which people are there"});
  }
}

std::vector<Problem> PeopleWatch::warnings() const {
  std::vector<Problem> warnings;
  if (outside_ > 0) {
    warnings.push_back({"", kScenario,
                        fmt::format("{} of {} people who start outside of the scenario's "
                                    "\"inside\", which no figure counts until they are there",
                                    outside_, arrived_),
                        "groups and sources inside of it, or a larger \"inside\""});
  }
  if (alarm_s_ && time_s_ < *alarm_s_) {
    // Images of people before an alarm are worth having, figures are not.
    if (!images_from_s_) warnings.push_back(late_alarm(*alarm_s_, time_s_));
  } else if (alarm_s_ && arrived_ > 0 && started_ == 0) {
    warnings.push_back({"", kScenario,
                        fmt::format("nobody inside at the alarm, at {:.4g} s, or later: all {} "
                                    "people had left",
                                    *alarm_s_, arrived_),
                        "people who are there when the alarm is raised"});
  }
  for (Problem& warning : idleness()) warnings.push_back(std::move(warning));
  add_emptiness(warnings);
  return warnings;
}

}  // namespace throng::sim
