// The tests of RiMEA and NIST, reduced, with the model that jobs get.
#include "validation/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.h"

namespace throng::validation {
namespace {

class Default : public testing::TestWithParam<std::string> {};

/// Tests that it fails: docs/validation.md says by how much.
const std::set<std::string> kKnownFailures = {"imo_4"};

TEST_P(Default, Passes) {
  const Results results = run_suite(chosen_models({"ttc"}), {GetParam()}, Effort::reduced, 1);
  const Verdict& verdict = results.verdicts[0][0];
  EXPECT_NE(verdict.passed, kKnownFailures.contains(GetParam()))
      << verdict.measured << "; wanted: " << results.tests[0].criterion;
}

std::vector<std::string> all_ids() {
  std::vector<std::string> ids;
  for (const auto& test : all_tests()) ids.push_back(test.id);
  return ids;
}

INSTANTIATE_TEST_SUITE_P(Suite, Default, testing::ValuesIn(all_ids()),
                         [](const auto& tested) { return tested.param; });

TEST(Suite, TellsModelsApart) {
  const Results results =
      run_suite(chosen_models({"orca", "weidmann"}), {"weidmann"}, Effort::reduced, 2);
  EXPECT_FALSE(results.verdicts[0][0].passed) << "orca does not slow down in a crowd";
  EXPECT_TRUE(results.verdicts[0][1].passed);
}

TEST(Suite, DoesNotDependOnThreads) {
  const std::vector<std::string> tests = {"rimea_9", "rimea_12d", "nist_2_8"};
  EXPECT_EQ(markdown(run_suite(chosen_models({"weidmann"}), tests, Effort::reduced, 1)),
            markdown(run_suite(chosen_models({"weidmann"}), tests, Effort::reduced, 4)));
}

TEST(Suite, HasUniqueIdsAndReportsAllOfThem) {
  const std::vector<std::string> ids = all_ids();
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  const std::string page =
      markdown(run_suite(chosen_models({"orca"}), {"rimea_1", "nist_2_1"}, Effort::reduced, 1));
  EXPECT_THAT(page, testing::HasSubstr("| RiMEA 1 | **+** 30."));
  EXPECT_THAT(page, testing::HasSubstr("| passed | 2 of 2 |"));
}

TEST(Suite, CountsOnlyDemandsOfItsSources) {
  const std::string page =
      markdown(run_suite(chosen_models({"orca"}), {"rimea_1", "rimea_4"}, Effort::reduced, 1));
  EXPECT_THAT(page, testing::HasSubstr("| RiMEA 4 | **o** "));
  EXPECT_THAT(page, testing::HasSubstr("| passed | 1 of 1 |"));
}

TEST(Suite, TestsOtherConstantsOfTheDefaultModel) {
  const auto conservative = chosen_models({}, crowd::ConstantsChoice::conservative);
  ASSERT_EQ(conservative.size(), 1) << "no other model has them";
  const Results results = run_suite(conservative, {"imo_4"}, Effort::reduced, 1);
  EXPECT_EQ(results.models, std::vector<std::string>{"ttc (conservative)"});
  EXPECT_TRUE(results.verdicts[0][0].passed) << results.verdicts[0][0].measured;
  EXPECT_THROW(chosen_models({"orca"}, crowd::ConstantsChoice::posterior), InputError);
}

TEST(Suite, RefusesUnknownNames) {
  EXPECT_THROW(chosen_models({"dance"}), InputError);
  EXPECT_THROW(run_suite(chosen_models({}), {"rimea_99"}, Effort::reduced, 1), InputError);
}

TEST(Suite, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(
      run_suite(chosen_models({"orca"}), {"rimea_1"}, Effort::reduced, 1, {}, stop.get_token()),
      Cancelled);
}

}  // namespace
}  // namespace throng::validation
