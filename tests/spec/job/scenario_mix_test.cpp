// Jobs of several scenarios.
#include "spec/job/scenario_mix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "spec/job/plan.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

JobSpec mixed(const json& scenarios, int runs, const json& more = json::object()) {
  json job = {{"scenario", scenarios}, {"runs", runs}};
  job.update(more);
  return parse_job(job.dump(), "mix.job.json");
}

std::string complaint(const json& scenarios, const json& more = json::object()) {
  try {
    mixed(scenarios, 4, more);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::map<std::string, int> count_scenarios(const JobSpec& job, int first, int end) {
  std::map<std::string, int> counts;
  for (int run = first; run < end; ++run) ++counts[in_scenario_of_run(job, run).scenario];
  return counts;
}

TEST(ScenarioMix, RunsAreSharedOutByWeight) {
  const JobSpec job =
      mixed({"a", {{"id", "b"}, {"weight", 3}}, {{"id", "c"}, {"weight", 0.5}}}, 90);
  EXPECT_EQ(count_scenarios(job, 0, 90),
            (std::map<std::string, int>{{"a", 20}, {"b", 60}, {"c", 10}}));
}

TEST(ScenarioMix, ConsecutiveRunsHoldEveryScenario) {
  const JobSpec job = mixed({"a", "b", "c"}, 30);
  for (int first = 0; first < 30; first += 3)
    EXPECT_EQ(count_scenarios(job, first, first + 3).size(), 3U);
}

TEST(ScenarioMix, MoreRunsBeginAsFewer) {
  const json scenarios = {"a", {{"id", "b"}, {"weight", 2.7}}, {{"id", "c"}, {"weight", 0.9}}};
  const JobSpec few = mixed(scenarios, 7);
  const JobSpec many = mixed(scenarios, 40);
  for (int run = 0; run < 7; ++run) {
    EXPECT_EQ(in_scenario_of_run(few, run).scenario, in_scenario_of_run(many, run).scenario);
  }
}

TEST(ScenarioMix, ARunHasThePeopleOfItsScenario) {
  const JobSpec job = mixed({"a", {{"id", "b"}, {"agents", 7}}}, 2, {{"crowd", {{"agents", 40}}}});
  EXPECT_EQ(job_of_run(job, 0).agents, 40);
  EXPECT_EQ(job_of_run(job, 1).agents, 7);
  EXPECT_EQ(samples_of_run(job, 1)["scenario"], "b");
}

TEST(ScenarioMix, SampledFieldsAreThoseOfTheRun) {
  const JobSpec job = mixed({"a", {{"id", "b"}, {"agents", 7}}}, 8,
                            {{"randomize", {{"crowd.agents", {{"uniform", {10, 20}}}}}}});
  std::set<int> agents;
  for (int run = 0; run < 8; ++run) {
    agents.insert(job_of_run(job, run).agents.value());
    EXPECT_GE(*agents.begin(), 10) << "the block randomize says more than the share";
  }
  EXPECT_GT(agents.size(), 3U);
}

TEST(ScenarioMix, AGeneratedScenarioWithoutASeedIsNewInEachRun) {
  const JobSpec job = mixed(
      {{{"generate", {{"kind", "street"}}}}, {{"generate", {{"kind", "plaza"}, {"seed", 5}}}}}, 8);
  std::set<std::string> streets;
  std::set<std::string> plazas;
  for (int run = 0; run < 8; ++run) {
    const JobSpec one = job_of_run(job, run);
    ASSERT_TRUE(one.generate);
    (one.generate->kind == "street" ? streets : plazas).insert(one.scenario);
  }
  EXPECT_EQ(streets.size(), 4U);
  EXPECT_EQ(plazas.size(), 1U);
  EXPECT_THAT(runs_alike(job, 0), ElementsAre(0)) << "no other run is in this street";
  EXPECT_THAT(runs_alike(job, 1), ElementsAre(1, 3, 5, 7));
}

TEST(ScenarioMix, APrintedJobIsReadBack) {
  const JobSpec job = mixed({"a",
                             {{"id", "b"}, {"weight", 2}, {"agents", 9}},
                             {{"generate", {{"kind", "block"}}}, {"weight", 0.5}}},
                            12, {{"outputs", {{"splits", {{"test_scenarios", {"b"}}}}}}});
  const json printed = to_json(job);
  const JobSpec again = parse_job(printed.dump(), "again");
  EXPECT_EQ(to_json(again), printed);
  for (int run = 0; run < 12; ++run) {
    EXPECT_EQ(to_json(job_of_run(again, run)), to_json(job_of_run(job, run)));
  }
}

TEST(ScenarioMix, SplitsGoByScenario) {
  const JobSpec job = mixed(
      {"a", "b", "c"}, 9, {{"outputs", {{"splits", {{"val", 0.25}, {"test_scenarios", {"c"}}}}}}});
  for (const auto& [run, split] : job.outputs.exports.splits.runs) {
    EXPECT_EQ(split, formats::Split::test);
    EXPECT_EQ(in_scenario_of_run(job, std::stoi(run.substr(3))).scenario, "c");
  }
  EXPECT_EQ(job.outputs.exports.splits.runs.size(), 3U);
}

TEST(ScenarioMix, ASplitTakesAllRunsOfAGeneratedEntry) {
  const json scenarios = {"a", {{"generate", {{"kind", "plaza"}}}}};
  const std::string generated = mixed(scenarios, 8).mix.at(1).scenario;
  const JobSpec job =
      mixed(scenarios, 8, {{"outputs", {{"splits", {{"test_scenarios", {generated}}}}}}});
  ASSERT_EQ(job.outputs.exports.splits.runs.size(), 4U);
  for (const auto& [run, split] : job.outputs.exports.splits.runs) {
    EXPECT_EQ(split, formats::Split::test);
    EXPECT_TRUE(job_of_run(job, std::stoi(run.substr(3))).generate) << run;
  }
}

TEST(ScenarioMix, MistakesAreNamedByTheirElement) {
  EXPECT_THAT(complaint(json::array()), HasSubstr("/scenario"));
  EXPECT_THAT(complaint({"a", {{"weight", 2}}}), HasSubstr("/scenario/1"));
  EXPECT_THAT(complaint({"a", {{"id", "b"}, {"wieght", 2}}}),
              HasSubstr("/scenario/1/wieght: unknown field \"wieght\"; did you mean \"weight\"?"));
  EXPECT_THAT(complaint({"a", {{"id", "b"}, {"weight", 0}}}), HasSubstr("/scenario/1/weight"));
  EXPECT_THAT(complaint({"a", {{"generate", {{"kind", "plazza"}}}}}), HasSubstr("/scenario/1"));
  EXPECT_THAT(complaint({"a", {{"generate", {{"kind", "plaza"}}}, {"id", "b"}}}),
              HasSubstr("/scenario/1"));
  EXPECT_THAT(
      complaint({"yard", "park"}, {{"outputs", {{"splits", {{"test_scenarios", {"prak"}}}}}}}),
      HasSubstr("/outputs/splits/test_scenarios/0"));
}

}  // namespace
}  // namespace throng::jobs
