#include "jobs/study/run_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files/hash.h"
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
    runs.push_back(measured(speed == 1 ? "fast<&>" : "slow", metrics::make_trace(walks), scenario));
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

nlohmann::json embedded_figures(const std::string& html) {
  const std::string start = "id=\"figures\">";
  const std::size_t from = html.find(start) + start.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(RunReport, HoldsChartsAndTables) {
  world::Scenario scenario = metrics::place_with_door(2);
  scenario.name = "A \"hall\" & <more>";
  scenario.buildings.push_back(metrics::box({-10, 5}, {-5, 8}));
  const std::string html = html_report(scenario, two_runs(scenario));
  EXPECT_EQ(count(html, "<div data-chart="), 11U) << "one of all runs, five of each";
  EXPECT_EQ(count(html, "<table>"), 5U);
  EXPECT_EQ(count(html, "type=\"radio\""), 2U) << "to choose a run by";
  EXPECT_EQ(count(html, " checked>"), 1U);
  EXPECT_EQ(count(html, "<section id="), 2U);
  EXPECT_EQ(count(html, "fast&lt;&amp;&gt;"), 5U);
  EXPECT_EQ(count(html, "fast<"), 0U) << "nor in the figures";
  EXPECT_NE(html.find("A &quot;hall&quot; &amp; &lt;more&gt;"), std::string::npos);
  EXPECT_EQ(html, html_report(scenario, two_runs(scenario)));
}

TEST(RunReport, SaysTheWarningsOfSimulationsOnce) {
  const world::Scenario scenario = metrics::place_with_door(2);
  std::vector<MeasuredRun> runs = two_runs(scenario);
  for (MeasuredRun& run : runs) run.warnings = {"an exit <into> a court"};
  runs[1].warnings.emplace_back("an alarm that nobody noticed");
  const std::string html = html_report(scenario, runs);
  EXPECT_EQ(count(html, "fast&lt;&amp;&gt; and 1 other: an exit &lt;into&gt; a court."), 1U);
  EXPECT_EQ(count(html, "slow: an alarm that nobody noticed."), 1U);
  EXPECT_EQ(count(html, "class=\"warning\""), 2U);
}

TEST(RunReport, RunsItsOwnScriptOnly) {
  const world::Scenario scenario = metrics::place_with_door(2);
  const std::string html = html_report(scenario, two_runs(scenario));
  EXPECT_EQ(count(html, "<script"), 2U) << "figures and the charts' script";
  EXPECT_EQ(count(html, "</script"), 2U) << "which nothing within them ends";
  EXPECT_EQ(count(html, "<!--"), 0U);
  const std::size_t from = html.rfind("<script>") + std::string("<script>").size();
  const std::string script = html.substr(from, html.rfind("</script>") - from);
  EXPECT_NE(html.find("default-src 'none'; script-src 'sha256-" + sha256_base64(script) + "'"),
            std::string::npos);
}

TEST(RunReport, ChartsHaveTheRunsFigures) {
  const world::Scenario scenario = metrics::place_with_door(2);
  const nlohmann::json figures = embedded_figures(html_report(scenario, two_runs(scenario)));
  const auto& escape = figures["escape"];
  EXPECT_EQ(escape["runs"][0]["name"], "fast<&>");
  const std::size_t last = escape["median"].size() - 1;
  EXPECT_EQ(escape["low"].size(), last + 1);
  EXPECT_EQ(escape["median"][0], 0);
  for (const char* curve : {"low", "median", "high"}) {
    EXPECT_LE(escape["low"][last], escape[curve][last]) << curve;
    EXPECT_GE(escape["high"][last], escape[curve][last]) << curve;
  }
  const auto& run = figures["runs"][1];
  double people = 0;
  for (const auto& density : run["density"]["values"]) people += density.get<double>();
  EXPECT_GT(people, 1) << "cells of 1 m²: the sum is the mean number of people";
  EXPECT_LE(people, 12);
  double covered_s = 0;
  for (const auto& span : run["exits"][0]["states"]) {
    covered_s += span[1].get<double>() - span[0].get<double>();
  }
  EXPECT_NEAR(covered_s, run["duration_s"].get<double>(), 1e-9) << "no time without a state";
  ASSERT_FALSE(run["fundamental"]["bins"].empty());
  for (const auto& bin : run["fundamental"]["bins"]) EXPECT_NEAR(bin[1], 0.8, 1e-3);
  EXPECT_EQ(run["paths"].size(), 12U);
  EXPECT_EQ(figures["place"]["exits"][0]["open"], true);
}

TEST(RunReport, ExplainsItsFigures) {
  const world::Scenario scenario = metrics::place_with_door(2);
  const std::string html = html_report(scenario, two_runs(scenario));
  EXPECT_NE(html.find(">people</a></td><td class=\"text\">1</td><td class=\"text\">who took "
                      "part</td><td>12</td><td>12 to 12</td><td>2</td>"),
            std::string::npos);
  EXPECT_NE(html.find("<td><a href=\"#def-escape_time_percentiles\">T90</a></td>"),
            std::string::npos);
  EXPECT_EQ(count(html, "<dt id=\"def-escape_time_percentiles\">"), 1U);
}

TEST(RunReport, SaysThatPeopleLeftByNoExit) {
  const world::Scenario scenario = metrics::place_with_door(2);
  std::vector<MeasuredRun> runs;
  runs.push_back(measured(
      "leak",
      metrics::make_trace({metrics::walking({-5, 0}, {1, 0}), metrics::walking({-5, 6}, {0, 1})}),
      scenario));
  const std::string html = html_report(scenario, runs);
  EXPECT_NE(html.find("<td>leak</td><td>2</td><td>1</td><td>1</td><td>0</td>"), std::string::npos)
      << "people, by the door, by no exit, inside";
  EXPECT_NE(html.find("1 of 2 people left the place where there is no exit"), std::string::npos);
}

TEST(RunReport, SaysWhichExitsAreClosed) {
  world::Scenario scenario = metrics::place_with_door(2);
  scenario.exits[0].closes_at_s = 1;
  std::vector<MeasuredRun> runs;
  runs.push_back(
      measured("late", metrics::make_trace({metrics::walking({-5, 3}, {0.1, 0})}), scenario));
  std::string html = html_report(scenario, runs);
  EXPECT_NE(html.find(scenario.exits[0].id + " (closed for "), std::string::npos);
  EXPECT_EQ(count(html, "<td>closed</td>"), 0U);
  scenario.exits[0].open = false;
  runs[0] = measured("never", metrics::make_trace({metrics::walking({-5, 3}, {0.1, 0})}), scenario);
  html = html_report(scenario, runs);
  EXPECT_NE(html.find(scenario.exits[0].id + " (closed)"), std::string::npos);
  EXPECT_EQ(count(html, "<td>closed</td>"), 1U) << "not: left by 0";
}

TEST(RunReport, NobodyIsNoError) {
  const world::Scenario scenario = metrics::place_with_door(2);
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("empty", metrics::make_trace({}), scenario));
  const std::string html = html_report(scenario, runs);
  EXPECT_NE(html.find("not reached"), std::string::npos);
  EXPECT_EQ(count(html, "type=\"radio\""), 0U) << "one run needs no choice";
  EXPECT_EQ(count(html, " to 0</td>"), 0U) << "nor has it quartiles";
}

TEST(RunReport, APlaceWithoutExitsHasNoEmptyPanel) {
  world::Scenario scenario = metrics::place_with_door(2);
  scenario.exits.clear();
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("open", metrics::make_trace({metrics::standing({0, 0})}), scenario));
  const std::string html = html_report(scenario, runs);
  EXPECT_EQ(count(html, "data-chart=\"timeline\""), 0U);
  EXPECT_NE(html.find("no exits"), std::string::npos);
}

TEST(RunReport, ADoorThatNobodyWantedToPassHasNoFlow) {
  const world::Scenario scenario = metrics::place_with_door(2);
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("calm", metrics::make_trace({metrics::standing({-9, 0})}), scenario));
  EXPECT_NE(
      html_report(scenario, runs)
          .find(
              "<td>door</td><td>2.00</td><td>2.60 (nominal)</td><td>0 / 0</td><td></td><td></td>"),
      std::string::npos);
}

}  // namespace
}  // namespace throng::study
