#include "metrics/people/escape_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/compute/random.h"
#include "metrics/evacuation.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

// Alarm at 5 s. One leaves before, one at 9 s; one arrives at 8 s and leaves at 14 s, one at 12 s
// and stays; one was there all the time and stays. The run ends at 20 s.
TEST(EscapeTimes, RunFromTheLaterOfAlarmAndArrival) {
  world::Scenario scenario = place_with_door_at_border(2);
  add_alarm(scenario, 5);
  CrowdOfTest crowd;
  crowd.duration_s = 20;
  const auto leaves_at = [](double time_s) -> Walk {
    return [time_s](double now_s) -> Eigen::Vector2d {
      return {now_s < time_s - 0.05 ? 5.0 : 15.0, 0};
    };
  };
  world::Trace trace = make_trace({leaves_at(3), leaves_at(9), leaves_at(14), standing({0, 0}),
                                   standing({1, 0}), standing({2, 0})},
                                  crowd);
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    if (step < 80) trace.flags[trace.at(step, 2)] = 0;
    if (step < 120) trace.flags[trace.at(step, 3)] = 0;
    trace.flags[trace.at(step, 5)] = 0;  // never comes
  }
  const RunMetrics run = run_metrics(trace, scenario, {});
  EXPECT_EQ(run.people, 5);
  EXPECT_EQ(run.escapes.left_before_alarm, 1);
  EXPECT_EQ(run.escapes.evacuees(), 4);
  EXPECT_EQ(run.not_escaped, 2);
  ASSERT_EQ(run.escapes.escape_s.size(), 2U);
  EXPECT_NEAR(run.escapes.escape_s[0], 4, 1e-6);
  EXPECT_NEAR(run.escapes.escape_s[1], 6, 1e-6);
  EXPECT_NEAR(run.escapes.percentile_s(50).value(), 6, 1e-6);
  EXPECT_FALSE(run.escapes.percentile_s(75));
  EXPECT_NEAR(run.mean_escape_time_s, (4 + 6 + 8 + 15) / 4.0, 1e-6);
  EXPECT_NEAR(run.escapes.restricted_mean_s(7).value(), (4 + 6 + 7 + 7) / 4.0, 1e-6);
  EXPECT_EQ(run.escapes.inside_after(5), 3);
  EXPECT_EQ(run.escapes.inside_after(10), 1) << "the late one was not watched for so long";
  const nlohmann::json json = to_json(run);
  EXPECT_EQ(json.at("people"), 5);
  EXPECT_EQ(json.at("left_before_alarm"), 1);
  EXPECT_EQ(json.at("alarm_s"), 5);
  EXPECT_NEAR(json.at("by_person").at("start_s").at(2), 8, 1e-6);
  EXPECT_NEAR(json.at("escape_curve").at("escaped_share").at(14), 3 / 5.0, 1e-9) << "by the clock";
}

TEST(EscapeTimes, CasualtiesStayForEver) {
  EscapeTimes times;
  times.escape_s = {10, 20};
  times.casualties = {{30, 5}, {30, 25}};
  EXPECT_EQ(times.evacuees(), 4);
  EXPECT_EQ(times.not_escaped(), 0);
  EXPECT_DOUBLE_EQ(times.mean_censored_s(), (10 + 20 + 30 + 30) / 4.0);
  EXPECT_DOUBLE_EQ(*times.restricted_mean_s(100), (10 + 20 + 100 + 100) / 4.0);
  EXPECT_EQ(times.inside_after(15), 2) << "one who escapes later, one who is hurt later";
  EXPECT_DOUBLE_EQ(times.curve().back(), 0.5);
}

/// Efron's construction (Proc. 5th Berkeley Symp. 4, 1967), which has no product: everybody has the
/// same mass, and who stops being watched hands theirs on to those to the right of them.
double redistributed_mean_s(std::vector<Watched> people, double until_s) {
  std::sort(people.begin(), people.end(), [](const Watched& one, const Watched& other) {
    return one.time_s != other.time_s ? one.time_s < other.time_s : one.happened > other.happened;
  });
  std::vector<double> mass(people.size(), 1.0 / static_cast<double>(people.size()));
  double mean_s = 0;
  for (std::size_t i = 0; i < people.size(); ++i) {
    const bool last = i + 1 == people.size();
    if (people[i].happened || people[i].time_s >= until_s || last) {
      mean_s += mass[i] * (people[i].happened ? std::min(people[i].time_s, until_s) : until_s);
      continue;
    }
    for (std::size_t k = i + 1; k < people.size(); ++k) {
      mass[k] += mass[i] / static_cast<double>(people.size() - i - 1);
    }
  }
  return mean_s;
}

TEST(RestrictedMean, HandsTheMassOfTheUnwatchedOn) {
  Random random(11, Stream::wind);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Watched> people;
    for (int i = 0; i < 30; ++i) people.push_back({random.uniform(0, 60), random.uniform() < 0.6});
    people.push_back({60, false});
    for (const double until_s : {10.0, 33.3, 60.0}) {
      EXPECT_NEAR(restricted_mean_s(people, until_s).value(), redistributed_mean_s(people, until_s),
                  1e-9)
          << trial;
    }
  }
}

}  // namespace
}  // namespace throng::metrics
