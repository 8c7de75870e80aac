// The report and the selection of tests and models.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/files/resources.h"
#include "crowd/state/model.h"
#include "validation/suite.h"

namespace throng::validation {
namespace {

Results made_by_hand() {
  Results results;
  results.models = {"ttc", "orca"};
  results.tests = {{"a_1", "A 1", "one person", "fast enough", {}},
                   {"a_2", "A 2", "two people", "slow enough", {}},
                   {"b_1", "B 1", "a ring", "reported", {}, false}};
  results.verdicts = {
      {{true, "1 s"}, {false, "9 s"}}, {{true, "2 s"}, {true, "3 s"}}, {{true, "x"}, {false, "y"}}};
  return results;
}

TEST(Report, HasARowPerTestAndAColumnPerModel) {
  const std::string page = markdown(made_by_hand());
  EXPECT_THAT(page, testing::StartsWith("# "));
  EXPECT_THAT(page, testing::HasSubstr("| test | ttc | orca |\n"
                                       "|---|---|---|\n"
                                       "| A 1 | **+** 1 s | **-** 9 s |\n"
                                       "| A 2 | **+** 2 s | **+** 3 s |\n"
                                       "| B 1 | **o** x | **o** y |\n"
                                       "| passed | 2 of 2 | 1 of 2 |\n"));
}

TEST(Report, DescribesEachTest) {
  const std::string page = markdown(made_by_hand());
  EXPECT_THAT(page, testing::HasSubstr("| A 1 | `a_1` | one person | fast enough |\n"
                                       "| A 2 | `a_2` | two people | slow enough |\n"
                                       "| B 1 | `b_1` | a ring | reported |\n"));
}

TEST(Report, SaysWhenItIsReduced) {
  Results results = made_by_hand();
  EXPECT_THAT(markdown(results), testing::Not(testing::HasSubstr("Reduced")));
  results.effort = Effort::reduced;
  EXPECT_THAT(markdown(results), testing::HasSubstr("Reduced (`--reduced`)"));
}

TEST(Report, FitsItsTableIntoMarkdown) {
  for (const auto& test : all_tests()) {
    for (const std::string& text : {test.id, test.title, test.set_up, test.criterion}) {
      EXPECT_FALSE(text.empty()) << test.id;
      EXPECT_EQ(text.find_first_of("|\n"), std::string::npos) << test.id << ": " << text;
    }
    EXPECT_EQ(test.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
        << test.id;
  }
}

/// The page in docs/ is what the program prints: each test is in it, as it is described here.
TEST(Report, IsThePageOfTheDocumentation) {
  std::ifstream file(source_folder() / "docs/validation.md");
  std::ostringstream page;
  page << file.rdbuf();
  ASSERT_GT(page.str().size(), 1000);
  for (const auto& test : all_tests()) {
    EXPECT_THAT(page.str(), testing::HasSubstr("| " + test.title + " | `" + test.id + "` | " +
                                               test.set_up + " | " + test.criterion + " |\n"));
  }
}

TEST(Selection, KeepsTheOrderGivenAndCountsProgress) {
  std::vector<std::size_t> done;
  std::size_t total = 0;
  const Results results = run_suite(chosen_models({"orca", "dummy"}), {"nist_2_1", "rimea_1"},
                                    Effort::reduced, 2, [&](std::size_t now, std::size_t all) {
                                      done.push_back(now);
                                      total = all;
                                    });
  EXPECT_EQ(results.models, (std::vector<std::string>{"orca", "dummy"}));
  ASSERT_EQ(results.tests.size(), 2);
  EXPECT_EQ(results.tests[0].id, "nist_2_1");
  EXPECT_EQ(results.tests[1].id, "rimea_1");
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3, 4}));
  EXPECT_EQ(total, 4);
  ASSERT_EQ(results.verdicts.size(), 2);
  for (const auto& of_test : results.verdicts) {
    ASSERT_EQ(of_test.size(), 2);
    for (const Verdict& verdict : of_test) EXPECT_FALSE(verdict.measured.empty());
  }
  EXPECT_THAT(results.verdicts[0][1].measured, testing::EndsWith("m/s")) << "by test, then model";
  EXPECT_THAT(results.verdicts[1][0].measured, testing::EndsWith(" s"));
}

/// No test is computed: the run is stopped before the first.
std::vector<std::string> rows_of_models(const std::vector<std::string>& names) {
  Results seen = run_suite(chosen_models(names), {"nist_2_1"}, Effort::reduced, 2);
  return seen.models;
}

TEST(Selection, TakesAllModelsButDummyWithTheDefaultFirst) {
  const std::vector<std::string> models = rows_of_models({});
  std::multiset<std::string> expected;
  for (const crowd::ModelEntry& entry : crowd::models()) expected.emplace(entry.name);
  expected.erase("dummy");
  EXPECT_EQ(std::multiset<std::string>(models.begin(), models.end()), expected);
  EXPECT_EQ(models.front(), "ttc");
}

void expect_refused(const std::vector<std::string>& models, const std::vector<std::string>& tests,
                    const std::vector<std::string>& words) {
  try {
    run_suite(chosen_models(models), tests, Effort::reduced, 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const std::string& word : words) EXPECT_THAT(error.what(), testing::HasSubstr(word));
  }
}

TEST(Selection, NamesTheUnknownTestAndTheKnownOnes) {
  expect_refused({"orca"}, {"rimea_1", "rimea_99"},
                 {"--tests", "rimea_99", "expected one of", "rimea_1,", "nist_5_1", "queue"});
  expect_refused({"orca"}, {"RiMEA 1"}, {"RiMEA 1"});
  expect_refused({"orca"}, {""}, {"--tests"});
}

TEST(Selection, NamesTheUnknownModelAndASimilarOne) {
  expect_refused({"orca", "wiedmann"}, {"rimea_1"},
                 {"pedestrian model", "\"wiedmann\"", "weidmann", "helbing"});
  expect_refused({""}, {"rimea_1"}, {"pedestrian model"});
}

TEST(Selection, RunsATestTwiceThatIsNamedTwice) {
  const Results results =
      run_suite(chosen_models({"orca"}), {"rimea_1", "rimea_1"}, Effort::reduced, 1);
  ASSERT_EQ(results.verdicts.size(), 2);
  EXPECT_EQ(results.verdicts[0][0].measured, results.verdicts[1][0].measured);
}

TEST(Sources, AreAllCoveredAsTheDocumentationSays) {
  std::set<std::string> titles;
  for (const auto& test : all_tests()) titles.insert(test.title);
  // RiMEA 4.1.1 without 2, 3, 13 (stairs), 8 (parameters), 14 (route choice over stairs).
  for (const char* number : {"1", "4", "5", "6", "7", "9", "10", "11", "15", "16"}) {
    EXPECT_TRUE(titles.contains(std::string("RiMEA ") + number)) << number;
  }
  for (const char* part : {"a", "b", "c", "d"}) {
    EXPECT_TRUE(titles.contains(std::string("RiMEA 12 ") + part)) << part;
  }
  for (const char* number : {"2.1", "2.3", "2.4", "2.8", "3.1", "4.1", "5.1"}) {
    EXPECT_TRUE(titles.contains(std::string("NIST ") + number)) << number;
  }
}

TEST(Sources, SetNoCriterionForDiagramAndExitChoice) {
  std::set<std::string> reported;
  for (const auto& test : all_tests()) {
    if (!test.demanded) reported.insert(test.id);
  }
  EXPECT_EQ(reported, (std::set<std::string>{"rimea_4", "rimea_11"}));
}

}  // namespace
}  // namespace throng::validation
