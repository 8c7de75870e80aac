#include "jobs/study/outcome.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"

namespace throng::study {

using nlohmann::json;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

double finite_or_never(const json& value) { return value.is_null() ? kNever : value.get<double>(); }

json best_json(const BestFigures& best) {
  return {{"t50_s", number(best.t50_s)},   {"t75_s", number(best.t75_s)},
          {"t90_s", number(best.t90_s)},   {"t95_s", number(best.t95_s)},
          {"t100_s", number(best.t100_s)}, {"mean_s", number(best.mean_s)}};
}

BestFigures best_from(const json& value) {
  return {finite_or_never(value.at("t50_s")),  finite_or_never(value.at("t75_s")),
          finite_or_never(value.at("t90_s")),  finite_or_never(value.at("t95_s")),
          finite_or_never(value.at("t100_s")), finite_or_never(value.at("mean_s"))};
}

BestFigures best_figures(const std::optional<metrics::BestTimes>& best) {
  if (!best) return {};
  const auto at = [&](int percent) { return best->percentile_s(percent).value_or(kNever); };
  return {at(50), at(75), at(90), at(95), at(100), best->mean_s};
}

}  // namespace

double Outcome::percentile_s(int percent) const {
  return escapes.percentile_s(percent).value_or(kNever);
}

double Outcome::restricted_mean_s(double until_s) const {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  return escapes.restricted_mean_s(until_s).value_or(unknown);
}

json to_json(const Outcome& outcome) {
  return {{"escapes", metrics::to_json(outcome.escapes)},
          {"people_counts", metrics::to_json(outcome.counts)},
          {"followed", outcome.followed},
          {"warnings", outcome.warnings},
          {"bound", best_json(outcome.bound)},
          {"reference", best_json(outcome.reference)}};
}

Outcome outcome_from(const json& value) {
  Outcome outcome;
  outcome.escapes = metrics::escape_times_from(value.at("escapes"));
  outcome.counts = metrics::people_counts_from(value.at("people_counts"));
  value.at("followed").get_to(outcome.followed);
  outcome.warnings = value.value("warnings", outcome.warnings);  // older results have none
  outcome.bound = best_from(value.at("bound"));
  outcome.reference = best_from(value.at("reference"));
  return outcome;
}

OutcomeObserver::OutcomeObserver(const world::Scenario& scenario, world::Alarm alarm,
                                 metrics::ReferenceSpec reference, std::string model)
    : scenario_(scenario),
      alarm_(std::move(alarm)),
      reference_(std::move(reference)),
      model_(std::move(model)) {}

OutcomeObserver::~OutcomeObserver() = default;

void OutcomeObserver::begin(const world::TraceHeader& header) {
  max_radius_m_ = metrics::max_radius_m(header);
  tracker_ = std::make_unique<metrics::PeopleTracker>(header, scenario_, alarm_);
}

void OutcomeObserver::step(const world::CrowdStep& step) {
  tracker_->step({step.time_s, step.position, step.velocity, step.desired_speed_mps, step.state,
                  step.exit_intent, step.flags});
}

bool OutcomeObserver::done() const { return tracker_ && tracker_->all_escaped(); }

Outcome OutcomeObserver::take() const {
  check(tracker_ != nullptr, "the run has begun");
  const std::vector<metrics::PersonRecord> people = tracker_->records();
  const double end_s = tracker_->time_s();
  Outcome outcome;
  outcome.escapes = metrics::escape_times(people, end_s);
  outcome.counts = metrics::count_people(people, scenario_.exits);
  outcome.followed = static_cast<int>(
      std::count_if(people.begin(), people.end(),
                    [](const metrics::PersonRecord& person) { return person.followed_s > 0; }));
  outcome.bound = best_figures(metrics::lower_bound(
      scenario_, people, alarm_, end_s, {model_, max_radius_m_, metrics::Knowledge::at_once}));
  outcome.reference = best_figures(metrics::reference_time(
      scenario_, people, alarm_, end_s, metrics::Knowledge::at_once, reference_));
  return outcome;
}

}  // namespace throng::study
