// Products of the tables of a job's fields: the schema's file, sampled values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "base/files/files.h"
#include "base/files/resources.h"
#include "spec/job/job_fields.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

using nlohmann::json;

const std::filesystem::path kSource = source_folder();

TEST(JobFields, TheSchemasFileIsThatOfTheTables) {
  EXPECT_TRUE(read_file(kSource / "spec/job/job.schema.json") == job_schema_text())
      << "run: build/release/spec/job_schema .";
}

TEST(JobFields, EveryPathIsUniqueAndHasTitleAndHelp) {
  std::set<std::string> paths;
  const auto look = [&](const auto& table, const std::string& place) {
    for (const FieldRules& field : table.fields()) {
      EXPECT_TRUE(paths.insert(place + field.path).second) << field.path;
      EXPECT_FALSE(field.title.empty()) << field.path;
      EXPECT_FALSE(field.help.empty()) << field.path;
    }
  };
  look(job_fields(), "");
  look(drone_fields(), "drones/0/");
  EXPECT_GT(paths.size(), 80U);
}

// Results of the version before the tables for 9 jobs, 8 of them random:
// tests/spec/job/recorded_jobs.jsonl. Fields that have come since may be there beside the
// recorded ones; "centre" of guidance is printed by its new name, "iso" has no default, and the
// defaults of the crowd's separation and of the share of umbrellas were "soft" and 0.05.
bool is_new_default(const json& found, const json& recorded, const std::string& place) {
  return (place.ends_with("/crowd/separation") && found == "auto") ||
         (place.ends_with("/appearance/umbrellas") && recorded == 0.05 && found == 0.33);
}

void expect_holds(const json& found, const json& recorded, const std::string& place) {
  if (recorded.is_object() && found.is_object()) {
    for (const auto& [key, value] : recorded.items()) {
      ASSERT_TRUE(found.contains(key)) << place << "/" << key;
      expect_holds(found[key], value, place + "/" + key);
    }
  } else if (recorded.is_array() && found.is_array()) {
    ASSERT_EQ(found.size(), recorded.size()) << place;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      expect_holds(found[i], recorded[i], place + "/" + std::to_string(i));
    }
  } else if (!is_new_default(found, recorded, place)) {
    EXPECT_EQ(found, recorded) << place;
  }
}

TEST(JobFields, JobsAreReadPrintedAndDrawnAsBefore) {
  std::ifstream file(kSource / "tests/spec/job/recorded_jobs.jsonl");
  int jobs = 0;
  for (std::string line; std::getline(file, line); ++jobs) {
    SCOPED_TRACE(jobs);
    const json recorded = json::parse(line);
    const JobSpec job = parse_job(recorded["text"].dump(), "/some/where/job.json");
    expect_holds(to_json(job), recorded["job"], "");
    for (std::size_t run = 0; run < recorded["runs"].size(); ++run) {
      const int number = static_cast<int>(run);
      expect_holds(to_json(job_of_run(job, number)), recorded["runs"][run], "/run");
      EXPECT_EQ(samples_of_run(job, number), recorded["drawn"][run]);
    }
  }
  EXPECT_EQ(jobs, 9);
}

// Values that runs draw are set by the tables: nothing else of the job changes.
TEST(JobFields, DrawnValuesChangeOnlyTheirFields) {
  const JobSpec job = parse_job(
      R"({"scenario": "yard", "runs": 3,
          "drones": [{"id": "a", "start": [1, 2, 30],
                      "guidance": {"policy": "pilot_log", "setpoints": [[0, 1, 2, 3, 77.7, 1]]}},
                     {"id": "b", "start": [4, 5, 60]}],
          "randomize": {"drones.1.start.2": {"choice": [61]}, "quality": {"choice": ["high"]},
                        "drones.0.guidance.speed_mps": {"choice": [2.5]},
                        "outputs.image.quality": {"choice": [40]}}})",
      "job.json");
  json expected = to_json(job);
  expected.erase("randomize");
  expected["drones"][1]["start"][2] = 61.0;
  expected["quality"] = "high";
  expected["drones"][0]["guidance"]["speed_mps"] = 2.5;
  expected["outputs"]["image"]["quality"] = 40;
  const JobSpec run = job_of_run(job, 1);
  EXPECT_EQ(to_json(run), expected);
  // To the last bit, although the job writes degrees.
  EXPECT_EQ(run.drones[0].mission.guidance.setpoints[0].yaw_rad,
            job.drones[0].mission.guidance.setpoints[0].yaw_rad);
}

// A run of a job whose pilot log is still a file: the file's name stays.
TEST(JobFields, DrawingKeepsThePilotLog) {
  const JobSpec job = parse_job(
      R"({"scenario": "yard", "drones": [{"id": "a", "guidance": {"policy": "pilot_log", "log": "x.csv"}}],
          "randomize": {"outputs.image.quality": {"choice": [40]}}})",
      "/somewhere/job.json");
  EXPECT_EQ(job_of_run(job, 0).drones[0].pilot_log, "/somewhere/x.csv");
}

TEST(JobFields, PlacesThatAJobDoesNotHaveAreRefused) {
  // A drone's camera holds its distributions itself: without the drone there is nothing to hold it.
  std::vector<Problem> problems;
  read_job(parse_job_document(R"({"scenario": "yard",
                "randomize": {"drones.0.camera.pitch_deg": {"choice": [-40, -50]}}})",
                              ""),
           "", problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/randomize/drones.0.camera.pitch_deg");
  // Drones and starts that the scenario lends are not known yet.
  for (const char* path : {"drones.0.guidance.speed_mps", "drones.0.start.2"}) {
    const JobSpec job = parse_job(
        R"({"scenario": "yard", "randomize": {")" + std::string(path) + R"(": {"choice": [3]}}})",
        "");
    EXPECT_THROW(job_of_run(job, 0), InputError) << path;
  }
  const JobSpec without_start = parse_job(
      R"({"scenario": "yard", "drones": [{"id": "a"}], "randomize": {"drones.0.start.2": {"choice": [3]}}})",
      "");
  EXPECT_THROW(job_of_run(without_start, 0), InputError);
}

}  // namespace
}  // namespace throng::jobs
