#include "jobs/supervisor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/jobs/fake_executor.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class SupervisorTest : public testing::Test {
 protected:
  SupervisorTest() {
    write_yard(scenarios.path());
    // Two runs of three frames: three shards each.
    job = parse_job(R"({"scenario": "yard", "runs": 2, "capture": {"to_s": 2}})", "",
                    scenarios.path());
  }

  JobFolder folder() const { return JobFolder::create(base.path() / "job", job); }

  TemporaryFolder scenarios;
  TemporaryFolder base;
  JobSpec job;
  FakeExecutor executor;
};

TEST_F(SupervisorTest, DoesEveryTaskOnceSimulationsFirstDatasetLast) {
  run_job(folder(), job, executor);
  EXPECT_THAT(executor.done(),
              ElementsAre("run000/trace", "run001/trace", "run000/metrics", "run000/shard0000",
                          "run000/shard0001", "run000/shard0002", "run001/metrics",
                          "run001/shard0000", "run001/shard0001", "run001/shard0002", "dataset"));
}

TEST_F(SupervisorTest, TakesUpWhereAnEarlierOneStopped) {
  executor.before = [](const Task& task) {
    return name_of(task) == "run001/metrics" ? TaskResult{Outcome::crashed, 3, "m", {}}
                                             : TaskResult{};
  };
  EXPECT_THROW(run_job(folder(), job, executor), EnvironmentError);
  FakeExecutor second;
  run_job(folder(), job, second);
  EXPECT_THAT(second.done(), ElementsAre("run001/metrics", "dataset"));
  FakeExecutor third;
  run_job(folder(), job, third);
  EXPECT_TRUE(third.done().empty());
}

TEST_F(SupervisorTest, RemovesWhatDeadWorkersLeft) {
  const std::filesystem::path leftover =
      folder().path() / "work" / "run000" / "shard0000.tmp.12345.0" / "files";
  std::filesystem::create_directories(leftover);
  run_job(folder(), job, executor);
  EXPECT_FALSE(std::filesystem::exists(leftover.parent_path()));
}

TEST_F(SupervisorTest, AFailureNamesTheTaskAndTheReason) {
  executor.before = [](const Task& task) {
    return name_of(task) == "run000/shard0001" ? TaskResult{Outcome::crashed, 3, "boom", {}}
                                               : TaskResult{};
  };
  try {
    run_job(folder(), job, executor);
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("run000/shard0001: boom (after 3 attempts)"));
  }
  EXPECT_THAT(executor.done(), Not(Contains("dataset")));
}

TEST_F(SupervisorTest, AnInputErrorKeepsItsProblems) {
  executor.before = [](const Task&) {
    return TaskResult{Outcome::input_error, 1, "m", {{"", "/crowd/agents", "300", "at most 260"}}};
  };
  try {
    run_job(folder(), job, executor);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].where, "/crowd/agents");
  }
}

TEST_F(SupervisorTest, AWorkerThatLiesIsFoundOut) {
  class Liar : public Executor {
    std::vector<TaskResult> run(const JobFolder&, std::span<const Task> tasks, const OnProgress&,
                                std::stop_token) override {
      return std::vector<TaskResult>(tasks.size());
    }
  } liar;
  EXPECT_THROW(run_job(folder(), job, liar), EnvironmentError);
}

TEST_F(SupervisorTest, StoppingIsCancelled) {
  std::stop_source stop;
  executor.before = [&](const Task& task) {
    if (name_of(task) == "run000/shard0000") stop.request_stop();
    return TaskResult{};
  };
  EXPECT_THROW(run_job(folder(), job, executor, {}, stop.get_token()), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder().dataset()));
}

TEST_F(SupervisorTest, ProgressOnlyGrowsAndEndsComplete) {
  JobProgress last;
  run_job(folder(), job, executor, [&](const JobProgress& progress) {
    ASSERT_EQ(progress.size(), 2U);
    for (std::size_t run = 0; run < last.size(); ++run) {
      EXPECT_GE(progress[run].images_done, last[run].images_done);
      EXPECT_GE(progress[run].stage, last[run].stage);
      EXPECT_EQ(progress[run].images_total, 3);
    }
    last = progress;
  });
  for (const RunProgress& run : last) {
    EXPECT_EQ(run.stage, Stage::finished);
    EXPECT_EQ(run.images_done, 3);
    EXPECT_EQ(run.simulated_s, 2);
  }
}

TEST_F(SupervisorTest, AFolderBelongsToOneJob) {
  folder();
  EXPECT_EQ(to_json(folder().read_job(scenarios.path())), to_json(job));
  job.seed = 99;
  EXPECT_THROW(folder(), InputError);
  write_file_atomically(base.path() / "other" / "file", "x");
  EXPECT_THROW(JobFolder::create(base.path() / "other", job), InputError);
}

}  // namespace
}  // namespace throng::jobs
