// Profile of a job's rendering, as workers write it and users read it.
#include "jobs/queue/profile.h"
#include "spec/job/spec.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

class Profile : public testing::Test {
 protected:
  Profile() {
    folder_.emplace(JobFolder::create(work_.path() / "job", ResolvedJob(job_)));
    std::filesystem::create_directories(folder_->path() / "logs");
  }

  TemporaryFolder work_;
  JobSpec job_ = parse_job(R"({"scenario": "yard", "runs": 2, "capture": {"to_s": 2},
                               "drones": [{"id": "d1"}]})",
                           "");
  std::optional<JobFolder> folder_;
};

TEST_F(Profile, AddsUpAllWorkersDearestStageFirst) {
  StageClock clock;
  clock.lap("draw");
  std::this_thread::sleep_for(std::chrono::milliseconds(12));
  clock.lap("read back");
  for (int run = 0; run < 2; ++run) {
    write_profile(*folder_, {Task::Kind::render, run, 0}, clock, 3);
  }
  const std::string table = profile_table(*folder_, job_);
  EXPECT_NE(table.find("all of 6 images"), std::string::npos) << table;
  EXPECT_NE(table.find("CPU ms/image"), std::string::npos);
  // 12 ms twice over six images.
  const std::size_t row = table.find("read back");
  ASSERT_NE(row, std::string::npos);
  EXPECT_NE(table.find("draw"), std::string::npos);
  double cpu_ms = -1;
  double wall_ms = -1;
  ASSERT_EQ(std::sscanf(table.c_str() + row, "read back %lf %lf", &cpu_ms, &wall_ms), 2);
  EXPECT_GE(wall_ms, 4.0);
}

TEST_F(Profile, SaysSoWhenNothingWasDrawn) {
  EXPECT_NE(profile_table(*folder_, job_).find("no frame was rendered"), std::string::npos);
}

}  // namespace
}  // namespace throng::jobs
