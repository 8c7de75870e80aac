// Metrics of a trace, a study's outcome and figures counted here from the bare trace are the same,
// on every shipped scenario.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/files/resources.h"
#include "jobs/study/outcome.h"
#include "metrics/evacuation.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "sim/run.h"
#include "tests/world/temporary_folder.h"

namespace throng::study {
namespace {

const std::filesystem::path kScenarioFolder = source_folder() / "scenarios";

/// Escape times counted without any of the library's definitions.
struct Counted {
  int in_header = 0;
  int people = 0;
  int left_before = 0;
  int turned_back = 0;  ///< came to an exit and did not enter
  int inside = 0;       ///< at the end, hurt or not
  int hurt = 0;
  std::vector<double> escape_s;  ///< in order
  double mean_s = 0;

  int evacuees() const { return people - left_before - turned_back; }
  double percentile_s(int percent) const {
    const auto needed = static_cast<std::size_t>(std::ceil(evacuees() * percent / 100.0 - 1e-9));
    const double never = std::numeric_limits<double>::infinity();
    return needed == 0 || needed > escape_s.size() ? never : escape_s[needed - 1];
  }
};

/// Whether a place is on the inner side of its nearest exit.
bool is_within(const world::Scenario& scenario, const Eigen::Vector2d& place) {
  double nearest_m = std::numeric_limits<double>::infinity();
  bool is_inner = true;
  for (const world::Exit& exit : scenario.exits) {
    for (int i = 0; i <= 1000; ++i) {
      const Eigen::Vector2d point = exit.from + i / 1000.0 * (exit.to - exit.from);
      if ((place - point).norm() >= nearest_m) continue;
      nearest_m = (place - point).norm();
      is_inner = (place - point).dot(exit.outward) < 0;
    }
  }
  return is_inner;
}

Counted counted(const world::Trace& trace, const world::Scenario& scenario,
                const std::optional<double>& alarm_s) {
  Counted counted;
  double sum_s = 0;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    ++counted.in_header;
    double arrived_s = -1;
    double escaped_s = -1;
    bool has_entered = false;
    bool hurt = false;
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      const bool there = (trace.flags[step * trace.agents() + agent] & 1) != 0;
      if (there && arrived_s < 0) arrived_s = trace.time_s[step];
      if (arrived_s < 0) continue;
      const Eigen::Vector2f& place = trace.position[step * trace.agents() + agent];
      const bool inside = place.x() >= scenario.inside.bounds.min.x() &&
                          place.x() <= scenario.inside.bounds.max.x() &&
                          place.y() >= scenario.inside.bounds.min.y() &&
                          place.y() <= scenario.inside.bounds.max.y();
      if (there && inside) escaped_s = -1;
      if (escaped_s >= 0) continue;
      if (!there || !inside) escaped_s = trace.time_s[step];
      has_entered = has_entered || (there && inside && is_within(scenario, place.cast<double>()));
      const std::string& state =
          trace.header.state_names.at(trace.state[step * trace.agents() + agent]);
      hurt = state.find("asualty") != std::string::npos || state.find("allen") != std::string::npos;
    }
    if (arrived_s < 0) continue;
    ++counted.people;
    if (!has_entered) {
      ++counted.turned_back;
      continue;
    }
    const double start_s = std::max(arrived_s, alarm_s.value_or(0));
    if (escaped_s >= 0 && escaped_s < start_s - 1e-6) {
      ++counted.left_before;
      continue;
    }
    if (escaped_s >= 0) {
      counted.escape_s.push_back(std::max(0.0, escaped_s - start_s));
    } else {
      ++counted.inside;
      if (hurt) ++counted.hurt;
    }
    sum_s += std::max(0.0, (escaped_s >= 0 ? escaped_s : trace.duration_s()) - start_s);
  }
  std::sort(counted.escape_s.begin(), counted.escape_s.end());
  const int evacuees = counted.evacuees();
  counted.mean_s = evacuees > 0 ? sum_s / evacuees : 0;
  return counted;
}

class Definitions : public ::testing::TestWithParam<std::string> {};

TEST_P(Definitions, OfStudyAndMetricsAreOne) {
  const world::Scenario scenario = scenarios::find_scenario(kScenarioFolder, GetParam());
  sim::RunSpec spec;
  spec.seed = 90210;
  const bool is_large = GetParam().rfind("concert", 0) == 0 || GetParam().rfind("stadium", 0) == 0;
  spec.duration_s = is_large ? 16 : 40;
  spec.people = GetParam().rfind("city_square", 0) == 0 ? 120 : 60;
  if (GetParam().find("huang2016") != std::string::npos) {
    spec.crowd.compat = crowd::Compat::huang2016;
  }
  const throng::testing::TemporaryFolder folder;
  sim::simulate(scenario, spec, folder.path() / "run.h5");
  const world::Trace trace = world::read_trace(folder.path() / "run.h5");
  const metrics::RunMetrics run =
      metrics::run_metrics(trace, scenario, metrics::exit_series(trace, scenario));

  metrics::ReferenceSpec reference;
  for (const world::Exit& exit : scenario.exits) {
    reference.capacity_per_s.push_back(1.3 * exit.width_m());
  }
  OutcomeObserver observer(scenario, world::find_alarm(scenario), reference,
                           sim::model_for(scenario, spec.crowd));
  sim::simulate(scenario, spec, observer);
  const Outcome outcome = observer.take();

  const bool is_emergency = GetParam().find("everyday") == std::string::npos;
  ASSERT_EQ(run.alarm_s.has_value(), is_emergency);
  const Counted expected = counted(trace, scenario, run.alarm_s);
  EXPECT_EQ(run.people, expected.people);
  EXPECT_EQ(outcome.escapes.people, expected.people);
  EXPECT_EQ(run.escapes.left_before_alarm, expected.left_before);
  EXPECT_EQ(outcome.escapes.left_before_alarm, expected.left_before);
  EXPECT_EQ(run.casualties, expected.hurt);
  EXPECT_EQ(run.not_escaped, expected.inside - expected.hurt);
  EXPECT_EQ(outcome.escapes.not_escaped(), expected.inside - expected.hurt);
  for (const int percent : {25, 50, 75, 90, 95}) {
    const double time_s = expected.percentile_s(percent);
    const double never = std::numeric_limits<double>::infinity();
    EXPECT_EQ(run.escapes.percentile_s(percent).value_or(never), time_s) << percent;
    EXPECT_EQ(outcome.percentile_s(percent), time_s) << percent;
  }
  EXPECT_NEAR(run.mean_escape_time_s, expected.mean_s, 1e-9);
  EXPECT_NEAR(outcome.escapes.mean_censored_s(), expected.mean_s, 1e-9);
  int left_by_exits = 0;
  for (std::size_t e = 0; e < scenario.exits.size(); ++e) {
    EXPECT_EQ(run.counts.left_by[e].people, outcome.counts.left_by[e].people)
        << scenario.exits[e].id;
    left_by_exits += run.counts.left_by[e].people;
  }
  EXPECT_EQ(left_by_exits, expected.evacuees() + expected.left_before - expected.inside);
  EXPECT_EQ(run.counts.turned_back, expected.turned_back);
  EXPECT_EQ(run.counts.left_by_no_exit, 0);
  EXPECT_EQ(run.counts.vanished_inside, 0);
  EXPECT_EQ(run.counts.never_inside, 0);
  EXPECT_EQ(run.guidance.led, outcome.followed);
  for (const metrics::PersonRecord& person : run.persons) {
    EXPECT_GE(person.noticed_s.value_or(person.start_s), person.start_s) << person.agent;
  }
  EXPECT_EQ(run.notification.has_value(), is_emergency);
  // Nothing beats a lower bound.
  ASSERT_TRUE(run.lower_bound);
  for (const int percent : {25, 50, 75, 90, 95, 100}) {
    const auto time_s = run.escapes.percentile_s(percent);
    if (!time_s) continue;
    EXPECT_LE(run.lower_bound->percentile_s(percent).value(), *time_s + 1e-6) << percent;
  }
  EXPECT_LE(run.lower_bound->mean_s, run.mean_escape_time_s + 1e-6);
  EXPECT_LE(outcome.bound.mean_s, run.lower_bound->mean_s + 1e-6) << "they know sooner";
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Shipped, Definitions,
                         ::testing::ValuesIn(world::list_scenarios(kScenarioFolder)), test_name);

// Many of the header's 250 people arrive after the run's end.
TEST(CountedPeople, AreThePeopleThatArrive) {
  const world::Scenario scenario =
      scenarios::find_scenario(kScenarioFolder, "city_square/emergency");
  sim::RunSpec spec;
  spec.seed = 7;
  spec.duration_s = 20;
  spec.people = 250;
  const throng::testing::TemporaryFolder folder;
  sim::simulate(scenario, spec, folder.path() / "run.h5");
  const world::Trace trace = world::read_trace(folder.path() / "run.h5");
  const Counted expected = counted(trace, scenario, 8.0);
  ASSERT_LT(expected.people, expected.in_header);
  metrics::ReferenceSpec reference;
  reference.capacity_per_s.assign(scenario.exits.size(), 1);
  OutcomeObserver observer(scenario, world::find_alarm(scenario), reference, "weidmann");
  sim::simulate(scenario, spec, observer);
  EXPECT_EQ(observer.take().escapes.people, expected.people);
}

// Walkers who head for an exit anyway are not warned before the fire starts (at 6 s).
TEST(NoticingPeople, KnowsOfTheAlarm) {
  const world::Scenario scenario = scenarios::find_scenario(kScenarioFolder, "station/emergency");
  EXPECT_EQ(world::find_alarm(scenario).at_s, 6);
  sim::RunSpec spec;
  spec.seed = 11;
  spec.duration_s = 30;
  const throng::testing::TemporaryFolder folder;
  sim::simulate(scenario, spec, folder.path() / "run.h5");
  const world::Trace trace = world::read_trace(folder.path() / "run.h5");
  const auto run = metrics::run_metrics(trace, scenario, {});
  int walkers = 0;
  int noticed = 0;
  for (const metrics::PersonRecord& person : run.persons) {
    // The behavior's states of people who know, as its author named them.
    std::optional<double> reacts_s;
    bool had_intent = false;
    for (std::size_t step = 0; step < trace.steps() && !reacts_s; ++step) {
      if (!trace.present(step, person.agent)) continue;
      const std::size_t at = trace.at(step, person.agent);
      const std::string& state = trace.header.state_names.at(trace.state[at]);
      if (state == "React" || state == "Flee") reacts_s = trace.time_s[step];
      had_intent = had_intent || (!reacts_s && trace.exit_intent[at] >= 0);
    }
    EXPECT_EQ(person.noticed_s, reacts_s) << person.agent;
    if (had_intent) ++walkers;
    if (person.noticed_s) ++noticed;
  }
  EXPECT_GT(walkers, 50) << "who walk to an exit before they know";
  EXPECT_GT(noticed, 100);
  EXPECT_GE(*run.notification->first_s, 6);
}

}  // namespace
}  // namespace throng::study
