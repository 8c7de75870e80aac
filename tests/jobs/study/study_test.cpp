// Studies: their files, their runs, and going on after an interruption.
#include "jobs/study/study.h"
#include "base/files/resources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/study/report.h"
#include "jobs/study/work.h"
#include "tests/world/temporary_folder.h"

namespace throng::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using throng::testing::TemporaryFolder;

const fs::path kScenarios = source_folder() / "scenarios";

json small_study() {
  return json::parse(R"({
    "name": "small", "seed": 5, "runs": 2, "baseline": "none",
    "cases": [{"id": "a", "scenario": "city_square/huang2016/nearest_exit_navigated",
               "crowd": {"agents": 30}, "duration_s": 20}],
    "policies": [{"id": "none"},
                 {"id": "guide", "drones": [{"id": "d1", "start": [0, 0, 20], "moves_goal": [99, 0],
                                             "guidance": {"policy": "balance"}}]}]
  })");
}

class StudyFile : public ::testing::Test {
 protected:
  Study load(const json& document) {
    return load_study(folder.write("study.json", document.dump()), kScenarios);
  }
  std::vector<Problem> list_problems(const json& document) {
    try {
      load(document);
    } catch (const InputError& error) {
      return error.problems();
    }
    return {};
  }

  TemporaryFolder folder;
};

TEST_F(StudyFile, MakesAJobOfEveryCaseAndPolicy) {
  const Study study = load(small_study());
  ASSERT_EQ(study.jobs.size(), 1U);
  ASSERT_EQ(study.jobs[0].size(), 2U);
  EXPECT_TRUE(study.jobs[0][0].drones.empty()) << "not even the scenario's";
  EXPECT_EQ(study.jobs[0][1].drones.size(), 1U);
  EXPECT_EQ(study.jobs[0][1].agents, 30);
  EXPECT_EQ(study.runs, 2);
}

TEST_F(StudyFile, APolicyWithoutDronesNeedsNoneOfTheScenario) {
  const std::string id = "city_square/huang2016/";
  fs::create_directories(folder.path() / id);
  fs::copy(kScenarios / id, folder.path() / id);
  const fs::path file = folder.path() / id / "nearest_exit.json";
  json scenario = json::parse(read_file(file));
  ASSERT_EQ(scenario.erase("drones"), 1U);
  std::ofstream(file) << scenario;
  json document = small_study();
  document["cases"][0]["scenario"] = id + "nearest_exit";
  document["policies"][0] = {{"id", "none"}};
  document["policies"][1] = {{"id", "none_either"}, {"drones", json::array()}};
  const Study study =
      load_study(folder.write("study.json", document.dump()), fs::path(folder.path()));
  EXPECT_TRUE(study.jobs[0][0].drones.empty());
  EXPECT_TRUE(study.jobs[0][1].drones.empty());
  EXPECT_EQ(study.jobs[0][0].crowd.model, "orca") << "still the scenario's";
}

TEST_F(StudyFile, OneDesignNeedsNoPolicy) {
  json document = small_study();
  document.erase("policies");
  document.erase("baseline");
  const Study one = load(document);
  ASSERT_EQ(one.jobs[0].size(), 1U);
  EXPECT_TRUE(one.jobs[0][0].drones.empty());
  EXPECT_FALSE(one.baseline_case.has_value());
  document["cases"].push_back(document["cases"][0]);
  document["cases"][1]["id"] = "b";
  EXPECT_EQ(load(document).baseline_case, 0U) << "two designs are compared";
  document["baseline_case"] = "b";
  EXPECT_EQ(load(document).baseline_case, 1U);
  document["baseline_case"] = "c";
  EXPECT_EQ(list_problems(document).at(0).where, "/baseline_case");
}

TEST_F(StudyFile, ACaseClosesExitsOfABlueprint) {
  json document = small_study();
  document.erase("policies");
  document.erase("baseline");
  json& one = document["cases"][0];
  one["scenario"] = "city_square/emergency";
  one.erase("crowd");
  const Study open = load(document);
  const std::string first = open.cases[0].scenario.exits[0].id;
  one["close"] = {first};
  const Study closed = load(document);
  EXPECT_FALSE(closed.cases[0].scenario.exits[0].open);
  EXPECT_TRUE(closed.cases[0].scenario.exits[1].open);
  EXPECT_NE(closed.fingerprints[0][0], open.fingerprints[0][0]);
  one["close"] = json::array();
  EXPECT_EQ(load(document).fingerprints[0][0], open.fingerprints[0][0]);
  one["close"] = {first, "Exit"};
  Problem problem = list_problems(document).at(0);
  EXPECT_EQ(problem.where, "/cases/0/close/1");
  EXPECT_THAT(problem.expected, HasSubstr("the id of an exit: " + first));
  one["scenario"] = "city_square/nearest_exit";  // with Menge's files
  one["close"] = {"exit1"};
  problem = list_problems(document).at(0);
  EXPECT_EQ(problem.where, "/cases/0/close");
  EXPECT_THAT(problem.found, HasSubstr("no blueprint"));
}

TEST_F(StudyFile, TheShippedOneIsFine) {
  const Study study = load_study(kScenarios / "city_square" / "study.json", kScenarios);
  EXPECT_EQ(study.runs, 24);
  EXPECT_EQ(study.policies[study.baseline].id, "none");
}

TEST_F(StudyFile, MistakesAreNamedWhereTheyStand) {
  const auto where = [&](const char* pointer, const json& value) {
    json document = small_study();
    document[json::json_pointer(pointer)] = value;
    const auto problems = list_problems(document);
    return problems.empty() ? std::string("accepted") : problems[0].where;
  };
  EXPECT_EQ(where("/cases/0/scenario", "atlantis"), "/cases/0/scenario");
  EXPECT_EQ(where("/cases/0/crowd", {{"agents", -1}}), "/cases/0/crowd/agents");
  EXPECT_EQ(where("/cases/0/alarm_s", 30), "/cases/0/alarm_s");
  EXPECT_EQ(where("/cases/0/reference", {{"capacity_per_s", {1, 2}}}),
            "/cases/0/reference/capacity_per_s");
  EXPECT_EQ(where("/cases/0/bound", {{"capacity_per_s", {1, 2}}}), "/cases/0/bound/capacity_per_s");
  EXPECT_EQ(where("/horizons_s", {5}), "/horizons_s");
  EXPECT_EQ(where("/horizons_s", {5, 30}), "/horizons_s/1") << "the run ends at 20 s";
  EXPECT_EQ(where("/horizons_s", {15, 10}), "/horizons_s/1");
  EXPECT_EQ(where("/horizons_s", {-1, 10}), "/horizons_s/0");
  EXPECT_EQ(where("/policies/1/id", "none"), "/policies/1/id");
  EXPECT_EQ(where("/policies/1/id", "None"), "/policies/1/id") << "one folder on Windows";
  EXPECT_EQ(where("/policies/1/id", "aux"), "/policies/1/id");
  EXPECT_EQ(where("/cases/0/id", "NUL"), "/cases/0/id");
  EXPECT_EQ(where("/policies/1/drones/0/guidance/policy", "dance"),
            "/policies/1/drones/0/guidance/policy");
  EXPECT_EQ(where("/policies/1/drones/0/start", {-16, -5, 3}), "/policies/1/drones/0/start");
  EXPECT_EQ(where("/baseline", "nobody"), "/baseline");
  EXPECT_EQ(where("/runs", 0), "/runs");
  EXPECT_EQ(where("/colour", "red"), "/colour");
  EXPECT_THROW(load_study(folder.path() / "nowhere.json", kScenarios), InputError);
}

class StudyWork : public StudyFile {
 protected:
  fs::path run_file(const char* policy, const char* run) const {
    return folder.path() / "out" / "runs" / "a" / policy / run;
  }
};

TEST_F(StudyWork, ResumesAndRepeatsDamagedRuns) {
  const Study study = load(small_study());
  const fs::path out = folder.path() / "out";
  std::stop_source stop;
  EXPECT_THROW(do_runs(
                   study, out, 1,
                   [&](std::size_t done, std::size_t) {
                     if (done == 2) stop.request_stop();
                   },
                   stop.get_token()),
               Cancelled);
  ASSERT_TRUE(fs::exists(run_file("none", "000.json")));
  ASSERT_TRUE(fs::exists(run_file("guide", "000.json")));
  EXPECT_FALSE(fs::exists(run_file("none", "001.json")));

  // A result with another value shows that it is not computed again.
  json marked = json::parse(read_file(run_file("none", "000.json")));
  marked["outcome"]["followed"] = 12345;
  write_file_atomically(run_file("none", "000.json"), marked.dump());
  write_file_atomically(run_file("guide", "000.json"), "{\"fingerprint\": ");
  const Outcomes outcomes = do_runs(study, out, 2);
  EXPECT_EQ(outcomes[0][0][0].followed, 12345);
  EXPECT_EQ(outcomes[0][1][0].escapes.people, 30);

  // Another study in the same folder has no use for any of them.
  json other = small_study();
  other["seed"] = 6;
  EXPECT_EQ(do_runs(load(other), out, 1)[0][0][0].followed, 0);
}

TEST_F(StudyWork, ResultsDoNotDependOnTheThreads) {
  const Study study = load(small_study());
  do_runs(study, folder.path() / "out", 1);
  const std::string one = read_file(run_file("guide", "001.json"));
  do_runs(study, folder.path() / "again", 3);
  EXPECT_EQ(one, read_file(folder.path() / "again" / "runs" / "a" / "guide" / "001.json"));
}

TEST_F(StudyFile, HorizonsAreThoseOfTheFileOrOfTheTimeWatched) {
  EXPECT_EQ(load(small_study()).cases[0].horizons_s, (std::array<double, 2>{10, 20}));
  json document = small_study();
  document["cases"][0]["duration_s"] = 900;
  document["cases"][0]["alarm_s"] = 100;
  EXPECT_EQ(load(document).cases[0].horizons_s, (std::array<double, 2>{150, 800}));
  document["horizons_s"] = {60, 300};
  EXPECT_EQ(load(document).cases[0].horizons_s, (std::array<double, 2>{60, 300}));
}

TEST_F(StudyFile, TheAlarmIsTheScenariosUnlessTheFileSaysOtherwise) {
  json document = small_study();
  document["cases"][0]["scenario"] = "station/emergency";
  document["cases"][0].erase("crowd");
  document["policies"].erase(1);
  EXPECT_EQ(load(document).cases[0].alarm.at_s, 6);
  document["cases"][0]["alarm_s"] = 3;
  EXPECT_EQ(load(document).cases[0].alarm.at_s, 3);
  document["cases"][0]["scenario"] = "station/everyday";
  document["cases"][0].erase("alarm_s");
  EXPECT_FALSE(load(document).cases[0].alarm.at_s);
}

TEST_F(StudyWork, AnOutcomeSurvivesItsFile) {
  Outcome outcome;
  outcome.escapes.people = 4;
  outcome.escapes.left_before_alarm = 1;
  outcome.escapes.escape_s = {5, 20};
  outcome.escapes.casualties = {{90, 7}};
  outcome.counts.left_by = {{"south", 1}, {"north", 2}};
  outcome.bound.t90_s = std::numeric_limits<double>::infinity();
  outcome.reference.t75_s = 12;
  const Outcome read = outcome_from(json::parse(to_json(outcome).dump()));
  EXPECT_DOUBLE_EQ(read.escapes.mean_censored_s(), (5 + 20 + 90) / 3.0);
  EXPECT_EQ(read.escapes.people, 4);
  EXPECT_EQ(read.escapes.casualties[0].hurt_s, 7);
  EXPECT_DOUBLE_EQ(read.percentile_s(50), 20);
  EXPECT_TRUE(std::isinf(read.percentile_s(90)));
  EXPECT_TRUE(std::isinf(read.bound.t90_s));
  EXPECT_EQ(read.reference.t75_s, 12);
  EXPECT_EQ(read.counts.left_by[1].exit_id, "north");
  EXPECT_EQ(read.counts.left_by[1].people, 2);
}

}  // namespace
}  // namespace throng::study
