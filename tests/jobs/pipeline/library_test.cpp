// The ready jobs of the library: every folder has one for every day and one for its emergency.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "base/files/files.h"
#include "base/files/resources.h"
#include "jobs/pipeline/checks/resolve.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {
namespace {

namespace fs = std::filesystem;
using ::testing::IsSupersetOf;

const fs::path kLibrary = source_folder() / "scenarios";

/// The scenarios that the ready jobs of a folder are for.
std::set<std::string> scenarios_of_jobs(const fs::path& folder) {
  std::set<std::string> scenarios;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.path().filename().string().ends_with(".job.json")) continue;
    const JobSpec job =
        resolve_job(parse_job_document(read_file(entry.path()), entry.path().string()),
                    entry.path().string(), kLibrary)
            .spec();
    EXPECT_FALSE(job.drones.empty()) << entry.path();
    EXPECT_NO_THROW(scenarios::find_scenario(kLibrary, job.scenario)) << entry.path();
    scenarios.insert(fs::path(job.scenario).filename().string());
  }
  return scenarios;
}

TEST(Library, HasJobsForEveryDayAndTheEmergencyOfEveryFolder) {
  std::size_t places = 0;
  for (const auto& entry : fs::directory_iterator(kLibrary)) {
    if (!entry.is_directory() || entry.path().filename() == "presets") continue;
    ++places;
    EXPECT_THAT(scenarios_of_jobs(entry.path()), IsSupersetOf({"everyday", "emergency"}))
        << entry.path();
  }
  EXPECT_EQ(places, 8U);
}

// Reading alone: what is checked against eight places and their crowds takes minutes.
TEST(Library, PresetsAreJobsOfAllScenarios) {
  std::size_t presets = 0;
  for (const auto& entry : fs::directory_iterator(kLibrary / "presets")) {
    ++presets;
    const JobSpec job = parse_job(read_file(entry.path()), entry.path().string());
    std::set<std::string> places;
    for (const ScenarioShare& share : job.mix) {
      if (share.generate) continue;
      EXPECT_NO_THROW(scenarios::find_scenario(kLibrary, share.scenario)) << entry.path();
      places.insert(fs::path(share.scenario).parent_path().string());
    }
    EXPECT_EQ(places.size(), 8U) << entry.path();
    EXPECT_TRUE(job.drones.at(0).mission.aim) << entry.path();
    EXPECT_FALSE(job.outputs.exports.splits.runs.empty()) << entry.path() << " tests a scenario";
  }
  EXPECT_EQ(presets, 6U);
}

TEST(Library, HasAReadyJobForEachOfTheFourCasesOfTheCitySquare) {
  EXPECT_THAT(scenarios_of_jobs(kLibrary / "city_square"),
              IsSupersetOf(
                  {"nearest_exit", "crowded_exit_blocked", "side_exit_blocked", "second_nearest"}));
}

}  // namespace
}  // namespace throng::jobs
