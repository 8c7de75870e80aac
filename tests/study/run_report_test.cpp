#include "study/run_report.h"

#include <gtest/gtest.h>

#include "study/plot.h"
#include "tests/metrics/walks.h"

namespace throng::study {
namespace {

std::vector<MeasuredRun> two_runs(const world::Scenario& scenario) {
  std::vector<MeasuredRun> runs;
  for (const double speed : {1.0, 0.8}) {
    std::vector<metrics::Walk> walks;
    for (int i = 0; i < 12; ++i) {
      walks.push_back(metrics::walking({-3.0 - 0.7 * i, 0.3 * (i % 3)}, {speed, 0}));
    }
    runs.push_back(measured(speed == 1 ? "fast<&>" : "slow", metrics::trace_of(walks), scenario));
  }
  return runs;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(RunReport, HoldsChartsAndTablesAndFetchesNothing) {
  world::Scenario scenario = metrics::place_with_door(2);
  scenario.name = "A \"hall\" & <more>";
  scenario.buildings.push_back(metrics::box({-10, 5}, {-5, 8}));
  const std::string html = html_report(scenario, two_runs(scenario));
  EXPECT_EQ(count(html, "<svg "), 11U) << "one of all runs, five of each";
  EXPECT_EQ(count(html, "</svg>"), 11U);
  EXPECT_EQ(count(html, "<table>"), 3U);
  EXPECT_EQ(count(html, "type=\"radio\""), 2U) << "to choose a run by";
  EXPECT_EQ(count(html, " checked>"), 1U);
  EXPECT_EQ(count(html, "<section id="), 2U);
  EXPECT_EQ(count(html, "<script"), 0U);
  EXPECT_EQ(count(html, "http"), 11U) << "the name space of each chart, nothing else";
  EXPECT_EQ(count(html, "nan"), 0U);
  EXPECT_EQ(count(html, "fast&lt;&amp;&gt;"), 6U);
  EXPECT_NE(html.find("A &quot;hall&quot; &amp; &lt;more&gt;"), std::string::npos);
  EXPECT_EQ(html, html_report(scenario, two_runs(scenario)));
}

TEST(RunReport, NobodyIsNoError) {
  const world::Scenario scenario = metrics::place_with_door(2);
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("empty", metrics::trace_of({}), scenario));
  const std::string html = html_report(scenario, runs);
  EXPECT_NE(html.find("not reached"), std::string::npos);
  EXPECT_EQ(count(html, "type=\"radio\""), 0U) << "one run needs no choice";
}

TEST(RunReport, PlotsScaleTheirAxes) {
  Plot plot({"t", "x", "y"}, {-10, 10}, {0, 5}, true);
  const std::vector<Eigen::Vector2d> points = {{-10, 0}, {10, 5}};
  plot.line(points, "red");
  const std::string svg = plot.svg();
  // 536 px for 20 units: 134 px for 5, and the margins.
  EXPECT_NE(svg.find("viewBox=\"0 0 760 218\""), std::string::npos) << svg.substr(0, 120);
  EXPECT_NE(svg.find("74.0,170.0 610.0,36.0"), std::string::npos);
}

}  // namespace
}  // namespace throng::study
