// The table and the charts.
#include "study/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/files.h"
#include "tests/world/temporary_folder.h"

namespace throng::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Outcome run_with(std::vector<double> escape_s, int people) {
  Outcome outcome;
  outcome.people = people;
  outcome.duration_s = 100;
  outcome.escape_s = std::move(escape_s);
  outcome.exit_use = {people};
  outcome.bound = {1, 10, 20, 5};
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
    study.cases[0].scenario.exits.resize(1);
    study.cases[0].scenario.exits[0].id = "door";
    study.policies = {{"none", "no drone"}, {"quick", "quick"}};
    outcomes.assign(1, std::vector<std::vector<Outcome>>(2));
    for (int i = 0; i < 8; ++i) {
      outcomes[0][0].push_back(run_with({20.0 + i, 40.0 + i}, 2));
      outcomes[0][1].push_back(run_with({15.0 + i, 35.0 + i}, 2));
    }
    outcomes[0][0][0].escape_s.pop_back();  // one who never gets out
  }

  Study study;
  Outcomes outcomes;
};

TEST(Report, ComparesPairByPair) {
  const Example example;
  const auto rows = summarise(example.study, example.outcomes);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].all_out, 7);
  EXPECT_EQ(rows[1].all_out, 8);
  EXPECT_DOUBLE_EQ(rows[1].mean_escape.median, 28.5);
  EXPECT_DOUBLE_EQ(rows[1].difference, (-35.0 - 7 * 5) / 8);
  EXPECT_DOUBLE_EQ(rows[1].test.p_value, 2.0 / 256) << "all eight pairs point one way";
  EXPECT_LT(rows[1].difference_95.high, 0);
  EXPECT_DOUBLE_EQ(rows[1].t90_to_bound, 3.85);
  EXPECT_DOUBLE_EQ(rows[0].ratio_to_baseline, 1);
  EXPECT_DOUBLE_EQ(rows[1].exit_use[0], 2);
}

TEST(Report, WritesTableAndCharts) {
  const Example example;
  const throng::testing::TemporaryFolder folder;
  write_report(example.study, example.outcomes, folder.path());
  const std::string table = read_file(folder.path() / "summary.md");
  EXPECT_THAT(table, HasSubstr("| quick |"));
  EXPECT_THAT(table, HasSubstr("0.0078"));
  EXPECT_THAT(read_file(folder.path() / "summary.csv"), HasSubstr("yard,quick,8,"));
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "summary.json"));
  EXPECT_EQ(summary["rows"][1]["exit_use"]["door"], 2);
  const std::string page = read_file(folder.path() / "report.html");
  EXPECT_THAT(page, HasSubstr("<h2>a &lt; b</h2>"));
  EXPECT_THAT(page, HasSubstr("data-chart=\"policies\" data-case=\"0\""));
  EXPECT_THAT(page, HasSubstr("{\"name\":\"no drone\",\"share\":[0.0,"));
  EXPECT_THAT(page.substr(0, page.find("<script")), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace throng::study
