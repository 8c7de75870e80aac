// The table and the charts.
#include "jobs/study/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "tests/world/temporary_folder.h"

namespace throng::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A run of two people, both watched for 100 s.
Outcome run_with(std::vector<double> escape_s) {
  Outcome outcome;
  outcome.escapes.people = 2;
  outcome.escapes.inside_s.assign(2 - escape_s.size(), 100);
  outcome.escapes.escape_s = std::move(escape_s);
  outcome.counts.left_by = {{"door", 2}};
  outcome.bound = {1, 2, 10, 15, 20, 5};
  outcome.reference = {2, 4, 20, 30, 40, 10};
  return outcome;
}

/// One case; the second policy is always 5 s quicker.
struct Example {
  Example() {
    study.name = "example";
    study.runs = 8;
    study.cases.resize(1);
    study.cases[0].id = "yard";
    study.cases[0].title = "a < b";
    study.cases[0].horizons_s = {30, 100};
    study.cases[0].scenario.exits.resize(1);
    study.cases[0].scenario.exits[0].id = "door";
    study.policies = {{"none", "no drone"}, {"quick", "quick"}};
    outcomes.assign(1, std::vector<std::vector<Outcome>>(2));
    for (int i = 0; i < 8; ++i) {
      outcomes[0][0].push_back(run_with({20.0 + i, 40.0 + i}));
      outcomes[0][1].push_back(run_with({15.0 + i, 35.0 + i}));
    }
    outcomes[0][0][0] = run_with({20});  // one who never gets out
  }

  Study study;
  Outcomes outcomes;
};

TEST(Report, ComparesPairByPair) {
  const Example example;
  const auto rows = summarize(example.study, example.outcomes);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].all_out, 7);
  EXPECT_EQ(rows[1].all_out, 8);
  EXPECT_DOUBLE_EQ(rows[0].not_escaped, 1.0 / 8);
  EXPECT_DOUBLE_EQ(rows[1].not_escaped, 0);
  // To 100 s: means of i + 25, but 60 for the first pair of the baseline.
  const MeanAtHorizon& whole = rows[1].means[1];
  EXPECT_DOUBLE_EQ(whole.at_s, 100);
  EXPECT_DOUBLE_EQ(whole.spread.median, 28.5);
  EXPECT_DOUBLE_EQ(whole.difference_s, (-35.0 - 7 * 5) / 8);
  EXPECT_DOUBLE_EQ(whole.test.p_value, 2.0 / 256) << "all eight pairs point one way";
  EXPECT_DOUBLE_EQ(whole.holm_p, 4.0 / 256) << "the least of two";
  EXPECT_LT(whole.difference_95.high, 0);
  EXPECT_DOUBLE_EQ(rows[0].means[1].inside, 1.0 / 8);
  // To 30 s the straggler counts like anybody who takes longer than that: 5 s less for the first
  // of the two, nothing for the second.
  const MeanAtHorizon& early = rows[1].means[0];
  EXPECT_DOUBLE_EQ(early.difference_s, -2.5);
  EXPECT_DOUBLE_EQ(rows[0].means[0].inside, 1);
  EXPECT_DOUBLE_EQ(early.test.p_value, 2.0 / 256);
  EXPECT_DOUBLE_EQ(early.holm_p, 4.0 / 256);
  EXPECT_DOUBLE_EQ(rows[1].t90_to_bound, 3.85);
  EXPECT_DOUBLE_EQ(rows[1].t90_to_reference, 3.85 / 2);
  EXPECT_DOUBLE_EQ(rows[0].means[1].ratio_to_baseline, 1);
  EXPECT_DOUBLE_EQ(rows[1].exit_use[0], 2);
}

/// Two designs and no policy: the second one is 10 s quicker, more or less.
Example designs() {
  Example example;
  example.study.policies = {{"no_drones", "no drones"}};
  example.study.cases.push_back(example.study.cases[0]);
  example.study.cases[1].id = "wide";
  example.study.cases[1].title = "wide";
  example.study.baseline_case = 0;
  example.outcomes.assign(2, std::vector<std::vector<Outcome>>(1));
  for (int i = 0; i < 8; ++i) {
    example.outcomes[0][0].push_back(run_with({20.0 + i, 40.0 + i}));
    example.outcomes[1][0].push_back(run_with({15.0 + i, 30.0 + i + (i % 2)}));
  }
  return example;
}

TEST(Report, GivesTheIntervalOfEachTime) {
  const Example example = designs();
  const auto rows = summarize(example.study, example.outcomes);
  const EscapePercentile& t95 = find_percentile(rows[0], 95);
  // 40, 41, ... 47: t(7, 0.975) = 2.365, standard deviation 2.4495.
  EXPECT_DOUBLE_EQ(t95.mean_s, 43.5);
  EXPECT_NEAR(t95.mean_95.high - t95.mean_s, 2.365 * 2.4495 / std::sqrt(8), 1e-3);
  EXPECT_TRUE(std::isinf(t95.high_95.high)) << "eight runs do not bound their 95th percentile";
  EXPECT_EQ(t95.runs_for_5_percent, 8) << "the half width is 2.05 s, 4.7 % of the mean";
  const Convergence settled = find_convergence(example.outcomes[0][0], 95);
  ASSERT_EQ(settled.mean_s.size(), 7U);
  EXPECT_DOUBLE_EQ(settled.mean_s[0], 40.5);
  EXPECT_DOUBLE_EQ(settled.mean_s[6], t95.mean_s);
  EXPECT_DOUBLE_EQ(settled.mean_95[6].low, t95.mean_95.low);
}

TEST(Report, ComparesDesigns) {
  const Example example = designs();
  const auto differences = compare_cases(example.study, example.outcomes);
  ASSERT_EQ(differences.size(), std::size(kIntervalPercents));
  EXPECT_DOUBLE_EQ(differences[0].difference_s, -5);
  EXPECT_EQ(differences[2].percent, 95);
  EXPECT_DOUBLE_EQ(differences[2].difference_s, -9.5);
  // -10 and -9 by turns: standard deviation 0.5345.
  EXPECT_NEAR(differences[2].difference_95.low, -9.5 - 2.365 * 0.5345 / std::sqrt(8), 1e-3);
  EXPECT_DOUBLE_EQ(differences[2].holm_p, 3 * 2.0 / 256);
  EXPECT_TRUE(compare_cases(Example().study, Example().outcomes).empty());
}

TEST(Report, ATimeThatSomeRunsDoNotReachHasNoInterval) {
  Example example = designs();
  example.outcomes[1][0][3] = run_with({15});
  const auto rows = summarize(example.study, example.outcomes);
  EXPECT_TRUE(std::isinf(find_percentile(rows[1], 95).mean_s));
  const auto differences = compare_cases(example.study, example.outcomes);
  EXPECT_TRUE(std::isnan(differences[2].difference_s));
  EXPECT_DOUBLE_EQ(differences[0].holm_p, 2.0 / 256) << "T90 and T95 make no test";
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  EXPECT_THAT(read_file(folder.path() / "summary.md"), HasSubstr("not everybody in every run"));
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "summary.json"));
  EXPECT_TRUE(summary["rows"][1]["times"]["t95_s"]["mean_s"].is_null());
}

TEST(Report, WritesDesignsAndTheirDifferences) {
  const Example example = designs();
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  const std::string table = read_file(folder.path() / "summary.md");
  EXPECT_THAT(table, HasSubstr("| wide | no drones | T95 | -9.5 [-9.9, -9.1] |"));
  EXPECT_THAT(table, Not(HasSubstr("ratio"))) << "there is nothing to compare a policy with";
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "summary.json"));
  EXPECT_EQ(summary["baseline_case"], "yard");
  EXPECT_EQ(summary["case_differences"][2]["difference_s"], -9.5);
  EXPECT_EQ(summary["rows"][0]["times"]["t95_s"]["mean_s"], 43.5);
  const std::string page = read_file(folder.path() / "report.html");
  EXPECT_THAT(page, HasSubstr("data-chart=\"convergence\" data-case=\"1\""));
  EXPECT_THAT(page, HasSubstr("\"mean_s\":[40.5,41.0,"));
}

TEST(Report, DrawsAllDesignsInOneChart) {
  const Example example = designs();
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  const std::string page = read_file(folder.path() / "report.html");
  EXPECT_THAT(page, HasSubstr("data-chart=\"policies\" data-case=\"2\""));
  EXPECT_THAT(page, HasSubstr("{\"name\":\"wide\",\"share\":[0.0,"));
}

TEST(Report, SaysWhichExitsAreClosed) {
  Example example = designs();
  example.study.cases[1].scenario.exits[0].open = false;
  for (Outcome& outcome : example.outcomes[1][0]) {
    outcome = run_with({});
    outcome.counts.left_by[0].people = 0;
    outcome.bound = outcome.reference = {};
  }
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  const std::string table = read_file(folder.path() / "summary.md");
  EXPECT_THAT(table, HasSubstr("| door 2 |"));
  EXPECT_THAT(table, HasSubstr("| – | – | door closed |"));
}

TEST(Report, SaysTheWarningsOfScenariosAndRunsEverywhere) {
  Example example;
  example.study.cases[0].findings = {"error: a \"court\""};
  example.outcomes[0][1][2].warnings = {"nobody noticed"};
  example.outcomes[0][1][3].warnings = {"nobody noticed"};
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  const std::string run = "under \"quick\" in 2 of 8 runs: nobody noticed";
  EXPECT_THAT(read_file(folder.path() / "summary.md"), HasSubstr("Warning: " + run));
  EXPECT_THAT(read_file(folder.path() / "summary.csv"),
              HasSubstr("\"error: a \"\"court\"\"; under"));
  EXPECT_THAT(read_file(folder.path() / "report.html"), HasSubstr("2 of 8 runs: nobody noticed"));
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "summary.json"));
  EXPECT_EQ(summary["warnings"][0]["text"], "error: a \"court\"");
  EXPECT_EQ(summary["warnings"][1]["case"], "yard");
  EXPECT_EQ(summary["warnings"][1]["text"], run);
  EXPECT_EQ(outcome_from(to_json(example.outcomes[0][1][2])).warnings.size(), 1U);
}

TEST(Report, AMeanThatIsNotKnownIsADashAndSaysWhy) {
  Example example;
  example.study.cases[0].horizons_s = {30, 200};  // longer than the one who stays is watched
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  for (const char* file : {"summary.md", "summary.csv"}) {
    const std::string text = read_file(folder.path() / file);
    EXPECT_THAT(text, Not(HasSubstr("nan"))) << file;
    EXPECT_THAT(text, HasSubstr("the mean to 200 s is not known")) << file;
  }
  EXPECT_THAT(read_file(folder.path() / "summary.md"), HasSubstr("| – |"));
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "summary.json"));
  EXPECT_TRUE(summary["rows"][0]["restricted_means"][1]["mean_s"].is_null());
}

TEST(Report, WritesTableAndCharts) {
  const Example example;
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  const std::string table = read_file(folder.path() / "summary.md");
  EXPECT_THAT(table, HasSubstr("| quick |"));
  EXPECT_THAT(table, HasSubstr("| mean to 30 s |"));
  EXPECT_THAT(table, HasSubstr("| 0.0078 | 0.016 |"));
  EXPECT_THAT(read_file(folder.path() / "summary.csv"), HasSubstr("yard,quick,8,"));
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "summary.json"));
  EXPECT_EQ(summary["rows"][1]["exit_use"]["door"], 2);
  EXPECT_EQ(summary["rows"][1]["restricted_means"][1]["until_s"], 100);
  EXPECT_EQ(summary["rows"][1]["restricted_means"][1]["holm_p"], 4.0 / 256);
  const std::string page = read_file(folder.path() / "report.html");
  EXPECT_THAT(page, HasSubstr("<h2>a &lt; b</h2>"));
  EXPECT_THAT(page, HasSubstr("data-chart=\"policies\" data-case=\"0\""));
  EXPECT_THAT(page, HasSubstr("{\"name\":\"no drone\",\"share\":[0.0,"));
  EXPECT_THAT(page.substr(0, page.find("<script")), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace throng::study
