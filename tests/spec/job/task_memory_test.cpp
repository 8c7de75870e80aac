#include "spec/estimates/task_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "spec/estimates/job_cost.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

constexpr Task kShard{Task::Kind::render};

JobSpec make_job(const std::string& camera, const std::string& rest = "") {
  return parse_job(
      R"({"scenario": "yard", "drones": [{"id": "d1", "start": [0, 0, 9], "camera": )" + camera +
          "}]" + rest + "}",
      "");
}

std::int64_t shard_mib(const std::string& camera, const std::string& rest = "") {
  return TaskMemory(make_job(camera, rest)).mib_of(kShard);
}

constexpr const char* kAllTruth =
    R"(, "outputs": {"annotations": ["coco", "depth", "instances", "parts", "normals", "flow"]})";

// Largest resident memory of workers that rendered city_square/nearest_exit with llvmpipe.
TEST(TaskMemory, IsAboveTheMeasuredOneByAtMostHalf) {
  struct Case {
    const char* camera;
    const char* rest;
    int measured_mib;
  };
  for (const Case& item : {
           Case{R"({"width": 320, "height": 180})", "", 745},
           Case{R"({"width": 320, "height": 180})", R"(, "quality": "draft")", 686},
           Case{R"({"width": 320, "height": 180})", R"(, "quality": "high")", 860},
           Case{R"({"width": 1920, "height": 1080})", "", 816},
           Case{R"({"width": 3840, "height": 2160})", "", 1041},
           Case{R"({"width": 7680, "height": 4320})", "", 1935},
           Case{R"({"width": 1920, "height": 1080})", R"(, "quality": "high")", 1041},
           Case{R"({"width": 3840, "height": 2160})", R"(, "quality": "high")", 1596},
           Case{R"({"width": 3840, "height": 2160})", kAllTruth, 1499},
           Case{R"({"width": 7680, "height": 4320})", kAllTruth, 3730},
           Case{R"({"width": 3840, "height": 2160, "model": "fisheye", "hfov_deg": 120})", "",
                2230},
       }) {
    const std::int64_t mib = shard_mib(item.camera, item.rest);
    EXPECT_GE(mib, item.measured_mib) << item.camera << item.rest;
    EXPECT_LE(mib, item.measured_mib * 3 / 2) << item.camera << item.rest;
  }
}

TEST(TaskMemory, RunsThatAreSampledCountAsTheyAre) {
  const JobSpec job =
      make_job(R"({"width": 3840, "height": 2160})",
               R"(, "runs": 20, "randomize": {"quality": {"choice": ["draft", "high"]}})");
  const TaskMemory memory(job);
  for (int run = 0; run < job.runs; ++run) {
    const bool is_high = job_of_run(job, run).quality == render::Quality::high;
    EXPECT_EQ(memory.mib_of({Task::Kind::render, run}) > 1596, is_high) << run;
  }
  EXPECT_GT(memory.max_mib(), 1596);
}

TEST(TaskMemory, PeopleCount) {
  const std::string job_text = R"(, "seed": 1)";
  EXPECT_GT(TaskMemory(make_job("{}", job_text), {20'000}).max_mib(),
            TaskMemory(make_job("{}", job_text)).max_mib() + 100);
  // A dry run announces the memory by which submission and admission decide.
  const JobSpec large = make_job("{}", job_text);
  EXPECT_EQ(estimate_cost(large, {20'000}).memory_mib, TaskMemory(large, {20'000}).max_mib());
  const std::int64_t few = TaskMemory(make_job("{}", R"(, "crowd": {"agents": 10})")).max_mib();
  const TaskMemory many(make_job("{}", R"(, "crowd": {"agents": 1000000})"));
  EXPECT_GT(many.max_mib(), few + 5000);
  EXPECT_GT(many.mib_of({Task::Kind::simulate}), 5000);
}

TEST(JobCost, AJobThatDoesNotFitOnTheFreeDiskIsWarnedOf) {
  const auto warnings = [](std::int64_t disk_bytes) {
    nlohmann::json answer = {{"estimate", estimate_json({.disk_bytes = disk_bytes})},
                             {"warnings", nlohmann::json::array()}};
    constexpr double kFreeBytes = 74e9;
    warn_of_full_disk(answer, kFreeBytes, "this disk");
    return answer["warnings"];
  };
  EXPECT_TRUE(warnings(74'000'000'000).empty());
  const nlohmann::json warned = warnings(1'700'000'000'000);
  ASSERT_EQ(warned.size(), 1U);
  EXPECT_EQ(warned[0]["pointer"], "/runs");
  EXPECT_EQ(warned[0]["found"], "a job of about 1.7 TB");
  EXPECT_THAT(warned[0]["expected"].get<std::string>(),
              testing::StartsWith("at most the 74 GB that are free on this disk"));
}

}  // namespace
}  // namespace throng::jobs
