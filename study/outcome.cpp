#include "study/outcome.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "metrics/crossings.h"

namespace throng::study {

using nlohmann::json;

namespace {

constexpr double kDoorMarginM = 0.5;  // discs rub along the jambs

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

double number_of(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

}  // namespace

double Outcome::mean_escape_s() const {
  if (people == 0) return 0;
  double sum = not_escaped() * (duration_s - alarm_s);
  for (const double time_s : escape_s) sum += time_s;
  return sum / people;
}

double Outcome::percentile_s(int percent) const {
  const auto needed = static_cast<std::size_t>((people * percent + 99) / 100);
  if (needed == 0) return 0;
  return needed <= escape_s.size() ? escape_s[needed - 1] : std::numeric_limits<double>::infinity();
}

json to_json(const Outcome& outcome) {
  return {{"people", outcome.people},
          {"duration_s", outcome.duration_s},
          {"alarm_s", outcome.alarm_s},
          {"escape_s", outcome.escape_s},
          {"exit_use", outcome.exit_use},
          {"followed", outcome.followed},
          {"bound",
           {{"t50_s", number(outcome.bound.t50_s)},
            {"t90_s", number(outcome.bound.t90_s)},
            {"t100_s", number(outcome.bound.t100_s)},
            {"mean_s", number(outcome.bound.mean_s)}}}};
}

Outcome outcome_from(const json& value) {
  Outcome outcome;
  value.at("people").get_to(outcome.people);
  value.at("duration_s").get_to(outcome.duration_s);
  value.at("alarm_s").get_to(outcome.alarm_s);
  value.at("escape_s").get_to(outcome.escape_s);
  value.at("exit_use").get_to(outcome.exit_use);
  value.at("followed").get_to(outcome.followed);
  const json& bound = value.at("bound");
  outcome.bound = {number_of(bound.at("t50_s")), number_of(bound.at("t90_s")),
                   number_of(bound.at("t100_s")), number_of(bound.at("mean_s"))};
  return outcome;
}

struct OutcomeObserver::Doors {
  std::vector<metrics::ExitLine> lines;
  std::vector<std::vector<metrics::CrossingCounter>> counters;  // per exit and agent
};

OutcomeObserver::OutcomeObserver(const world::Scenario& scenario, double duration_s, double alarm_s,
                                 metrics::BoundSpec bound_spec)
    : scenario_(scenario), bound_spec_(std::move(bound_spec)), doors_(std::make_unique<Doors>()) {
  outcome_.duration_s = duration_s;
  outcome_.alarm_s = alarm_s;
  outcome_.exit_use.resize(scenario.exits.size());
  for (const world::Exit& exit : scenario.exits) doors_->lines.emplace_back(exit, kDoorMarginM);
}

OutcomeObserver::~OutcomeObserver() = default;

void OutcomeObserver::begin(const world::TraceHeader& header) {
  roles_ = header.role;
  followed_.assign(roles_.size(), false);
  outcome_.people =
      static_cast<int>(std::count(roles_.begin(), roles_.end(), world::AgentRole::person));
  for (const std::string& state : header.state_names) follows_.push_back(state == "Follow");
  doors_->counters.assign(doors_->lines.size(),
                          std::vector<metrics::CrossingCounter>(roles_.size()));
}

void OutcomeObserver::step(const world::CrowdStep& step) {
  std::vector<Eigen::Vector2d> people;
  const bool alarm = !bound_done_ && step.time_s >= outcome_.alarm_s - world::kTimeSlackS;
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    if (roles_[i] != world::AgentRole::person || (step.flags[i] & world::kPresent) == 0) continue;
    const Eigen::Vector2d place = step.position[i].cast<double>();
    for (std::size_t e = 0; e < doors_->lines.size(); ++e) {
      outcome_.exit_use[e] += doors_->counters[e][i].step(doors_->lines[e], place);
    }
    if (follows_[step.state[i]] && !followed_[i]) {
      followed_[i] = true;
      ++outcome_.followed;
    }
    if (alarm) people.push_back(place);
  }
  if (!alarm) return;
  outcome_.bound = metrics::flow_bound(scenario_, people, bound_spec_);
  bound_done_ = true;
}

void OutcomeObserver::event(const world::TraceEvent& event) {
  if (event.type == "agent_escaped") {
    outcome_.escape_s.push_back(std::max(0.0, event.time_s - outcome_.alarm_s));
  }
}

bool OutcomeObserver::done() const { return outcome_.not_escaped() == 0 && bound_done_; }

Outcome OutcomeObserver::take() { return std::move(outcome_); }

}  // namespace throng::study
