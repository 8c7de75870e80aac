// Lessons of finished jobs about the machine's speed, and their use in checks.
#include "jobs/queue/machine_speed.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/queue/supervisor.h"
#include "spec/estimates/job_cost.h"
#include "spec/job/spec.h"
#include "tests/jobs/queue/fake_executor.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using nlohmann::json;

class MachineSpeedTest : public testing::Test {
 protected:
  /// Does a new job, each of whose tasks is said to take this long.
  void do_job(double task_cpu_s, int attempts = 1) {
    FakeExecutor executor;
    executor.before_in = [=](const JobFolder&, const Task&) {
      return TaskResult{Outcome::succeeded, attempts, "", {}, task_cpu_s};
    };
    const std::string name = std::to_string(jobs_++);
    run_job(JobFolder::create(base.path() / name, job), job, executor, {}, {}, share());
  }

  /// Does a new job that takes `factor` times its estimate. FakeExecutor says that two people took
  /// part, whom all images show.
  void do_job_with_factor(double factor) {
    do_job(factor *
           estimate_cost(job.spec(),
                         {{.people = 2, .at_a_time = 2, .in_view = {2.0}, .taking_part = 2}}, 0)
               .cpu_s /
           kTasks);
  }

  /// The estimate in the answer of a dry run.
  json checked() const {
    json answer = {{"estimate", estimate_json({.cpu_s = 10, .disk_bytes = 7})}};
    fit_to_machine(answer, file);
    return answer["estimate"];
  }

  bool is_learned() const { return checked()["basis"] == "this machine"; }

  Share share() const {
    Share share;
    share.speed_file = file;
    return share;
  }

  TemporaryFolder base;
  std::filesystem::path file = base.path() / "cache/speed.json";
  ResolvedJob job{parse_job(R"({"scenario": "yard", "capture": {"to_s": 2},
                    "drones": [{"id": "d1", "camera": {"width": 320, "height": 240}}]})",
                            "")};
  static constexpr int kTasks = 4;  ///< trace, metrics, shard, dataset

 private:
  int jobs_ = 0;
};

TEST_F(MachineSpeedTest, BeforeTheFirstJobTheReferenceMachineIsTaken) {
  EXPECT_EQ(
      checked(),
      json({{"cpu_s", 10}, {"disk_bytes", 7}, {"memory_mib", 0}, {"basis", "reference machine"}}));
}

TEST_F(MachineSpeedTest, AJobTeachesIt) {
  do_job_with_factor(2.5);
  EXPECT_EQ(checked(),
            json({{"cpu_s", 25}, {"disk_bytes", 7}, {"memory_mib", 0}, {"basis", "this machine"}}));
}

TEST_F(MachineSpeedTest, JobsCountAlikeAndOldOnesAreForgotten) {
  do_job_with_factor(4);
  do_job_with_factor(1);
  EXPECT_DOUBLE_EQ(checked()["cpu_s"], 20);
  do_job_with_factor(2);
  EXPECT_DOUBLE_EQ(checked()["cpu_s"], 20);
  for (int i = 0; i < 40; ++i) do_job_with_factor(0.5);
  EXPECT_NEAR(checked()["cpu_s"], 5, 0.11);
}

TEST_F(MachineSpeedTest, NoJobTeachesMoreThanAFactorOfEight) {
  do_job_with_factor(1e6);
  EXPECT_DOUBLE_EQ(checked()["cpu_s"], 80);
  std::filesystem::remove(file);
  do_job_with_factor(1e-6);
  EXPECT_DOUBLE_EQ(checked()["cpu_s"], 1.3);  // rounded
}

TEST_F(MachineSpeedTest, OnlyJobsWhoseWholeTimeIsKnownTeachIt) {
  do_job(0);  // on a cluster
  EXPECT_FALSE(is_learned());
  do_job(1, 2);  // tried again
  EXPECT_FALSE(is_learned());
  FakeExecutor interrupted;
  interrupted.before = [](const Task& task) {
    return task.kind == Task::Kind::render ? TaskResult{Outcome::crashed, 3, "", {}} : TaskResult{};
  };
  const JobFolder folder = JobFolder::create(base.path() / "resumed", job);
  EXPECT_THROW(run_job(folder, job, interrupted, {}, {}, share()), EnvironmentError);
  FakeExecutor second;
  second.before_in = [](const JobFolder&, const Task&) {
    return TaskResult{Outcome::succeeded, 1, "", {}, 1};
  };
  run_job(folder, job, second, {}, {}, share());
  EXPECT_FALSE(is_learned());
}

TEST_F(MachineSpeedTest, ContentThatMakesNoSenseIsIgnoredAndReplaced) {
  for (const std::string& content :
       {std::string(), std::string("{"), std::string("[]"), std::string("{}"), std::string("null"),
        std::string("\xff\xfe"), std::string(R"({"factor": "2", "jobs": 1})"),
        std::string(R"({"factor": -2, "jobs": 1})"), std::string(R"({"factor": 0, "jobs": 1})"),
        std::string(R"({"factor": null, "jobs": 1})"), std::string(R"({"factor": 2, "jobs": 0})"),
        std::string(R"({"factor": 2, "jobs": -3})"), std::string(R"({"factor": 2})"),
        std::string(500, '['),
        std::string(R"({"factor": 2, "jobs": 1})") + std::string(5000, ' ')}) {
    write_file_atomically(file, content);
    EXPECT_FALSE(is_learned()) << content;
    do_job_with_factor(2);
    EXPECT_DOUBLE_EQ(checked()["cpu_s"], 20) << content;
  }
  write_file_atomically(file, R"({"factor": 1e300, "jobs": 2147483647})");
  EXPECT_DOUBLE_EQ(checked()["cpu_s"], 80);
  do_job_with_factor(8);
  EXPECT_DOUBLE_EQ(checked()["cpu_s"], 80);
}

TEST_F(MachineSpeedTest, AJobSucceedsWithoutAPlaceForIt) {
  write_file_atomically(base.path() / "cache", "a file where the folder should be");
  do_job_with_factor(2);
  EXPECT_FALSE(is_learned());
  file = base.path();  // a folder where the file should be
  do_job_with_factor(2);
  EXPECT_FALSE(is_learned());
  file.clear();
  do_job_with_factor(2);
  EXPECT_FALSE(is_learned());
}

TEST_F(MachineSpeedTest, TheUsersFileIsInTheCache) {
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  ::setenv("HOME", "/home/user", 1);
  EXPECT_EQ(user_speed_file(), "/somewhere/throng/speed.json");
  ::setenv("XDG_CACHE_HOME", "not/absolute", 1);
  EXPECT_EQ(user_speed_file(), "/home/user/.cache/throng/speed.json");
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(user_speed_file(), "/home/user/.cache/throng/speed.json");
  ::unsetenv("HOME");
  EXPECT_EQ(user_speed_file(), "");
}

}  // namespace
}  // namespace throng::jobs
