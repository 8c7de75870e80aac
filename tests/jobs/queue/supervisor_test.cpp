#include "jobs/queue/supervisor.h"
#include "jobs/queue/workers/attempts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "base/error.h"
#include "jobs/queue/failed_runs.h"
#include "spec/job/spec.h"
#include "tests/jobs/queue/fake_executor.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class SupervisorTest : public testing::Test {
 protected:
  JobFolder folder() const { return JobFolder::create(base.path() / "job", job); }

  TemporaryFolder base;
  // Two runs of three frames that take long: three shards each.
  ResolvedJob job{
      parse_job(R"({"scenario": "yard", "runs": 2, "capture": {"to_s": 2}, "quality": "high",
                                "drones": [{"id": "d1", "camera": {"width": 3840, "height": 2160}}]})",
                "")};
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
    return task.kind == Task::Kind::measure ? TaskResult{Outcome::crashed, 3, "m", {}}
                                            : TaskResult{};
  };
  EXPECT_THROW(run_job(folder(), job, executor), EnvironmentError);
  FakeExecutor second;
  run_job(folder(), job, second);
  EXPECT_THAT(second.done(), ElementsAre("run000/metrics", "run001/metrics", "dataset"));
  FakeExecutor third;
  run_job(folder(), job, third);
  EXPECT_TRUE(third.done().empty());
}

// A server that is killed after the last task has ended, and before it has removed the attempts.
TEST_F(SupervisorTest, AJobThatIsDoneKeepsNoAttempts) {
  run_job(folder(), job, executor);
  AttemptArray left{"", {{"dataset", 1}}};
  create_attempts(folder(), left);
  FakeExecutor second;
  run_job(folder(), job, second);
  EXPECT_TRUE(second.done().empty());
  EXPECT_FALSE(std::filesystem::exists(attempts_folder(folder())));
}

ResolvedJob published_to(const ResolvedJob& job, const std::string& address) {
  JobSpec spec = job.spec();
  spec.outputs.publish = address;
  return ResolvedJob(spec);
}

TEST_F(SupervisorTest, PublishesTheDatasetOnceItIsThere) {
  job = published_to(job, "s3://data/set");
  std::vector<std::string> stages;
  std::optional<DeliveryProgress> delivery;
  run_job(folder(), job, executor, [&](const JobProgress& progress) {
    const std::string stage(to_string(progress.runs[0].stage));
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
    delivery = progress.delivery;
  });
  EXPECT_EQ(executor.done().back(), "publish");
  EXPECT_THAT(stages, ElementsAre("waiting", "simulating", "rendering", "rendered", "publishing",
                                  "finished"));
  ASSERT_TRUE(delivery);
  EXPECT_EQ(delivery->address, "s3://data/set");
  EXPECT_EQ(delivery->objects, 2);
  EXPECT_EQ(delivery->bytes_done, 20);
}

TEST_F(SupervisorTest, PublishingThatFailsLeavesTheDatasetAndIsTriedAgain) {
  job = published_to(job, "s3://data/set");
  executor.before = [](const Task& task) {
    return task.kind == Task::Kind::publish
               ? TaskResult{Outcome::environment_error, 3, "SlowDown", {}}
               : TaskResult{};
  };
  try {
    run_job(folder(), job, executor);
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_STREQ(error.what(), "publish: SlowDown (after 3 attempts)");
  }
  EXPECT_TRUE(folder().is_done({Task::Kind::collect}));
  FakeExecutor second;
  run_job(folder(), job, second);
  EXPECT_THAT(second.done(), ElementsAre("publish"));
}

TEST_F(SupervisorTest, AnotherAddressPublishesTheSameDatasetAgain) {
  job = published_to(job, "s3://data/set");
  run_job(folder(), job, executor);
  job = published_to(job, "s3://data/other");
  FakeExecutor second;
  run_job(folder(), job, second);
  EXPECT_THAT(second.done(), ElementsAre("publish"));
  EXPECT_EQ(folder().read_job().spec().outputs.publish, "s3://data/other");
  FakeExecutor third;
  run_job(folder(), job, third);
  EXPECT_TRUE(third.done().empty());
  job = published_to(job, "");
  run_job(folder(), job, third);
  EXPECT_TRUE(third.done().empty());
  EXPECT_FALSE(folder().is_done({Task::Kind::publish}));
}

TEST_F(SupervisorTest, ARunThatFailsLeavesTheOthersTheirDataset) {
  executor.before = [](const Task& task) {
    return to_string(task) == "run001/shard0002" ? TaskResult{Outcome::crashed, 3, "boom", {}}
                                                 : TaskResult{};
  };
  JobProgress last;
  const std::vector<RunFailure> failures =
      run_job(folder(), job, executor, [&](const JobProgress& progress) { last = progress; });
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].run, 1);
  EXPECT_EQ(failures[0].task, "run001/shard0002");
  EXPECT_EQ(failures[0].attempts, 3);
  EXPECT_THAT(failures[0].message, HasSubstr("boom (after 3 attempts)"));
  EXPECT_EQ(last.runs[0].stage, Stage::finished);
  EXPECT_EQ(last.runs[1].stage, Stage::failed);
  EXPECT_TRUE(folder().is_done({Task::Kind::collect}));
  ASSERT_EQ(read_failed_runs(folder()).size(), 1U);
  EXPECT_EQ(read_failed_runs(folder())[0].run, 1);

  // Again: missing tasks are done, and the dataset is collected again.
  FakeExecutor second;
  EXPECT_TRUE(run_job(folder(), job, second).empty());
  EXPECT_THAT(second.done(), ElementsAre("run001/shard0002", "dataset"));
  EXPECT_TRUE(read_failed_runs(folder()).empty());
}

TEST_F(SupervisorTest, ASimulationThatFailsIsNotDrawn) {
  executor.before = [](const Task& task) {
    return to_string(task) == "run000/trace" ? TaskResult{Outcome::timed_out, 3, "slow", {}}
                                             : TaskResult{};
  };
  EXPECT_EQ(run_job(folder(), job, executor).size(), 1U);
  EXPECT_THAT(executor.done(), ElementsAre("run001/trace", "run001/metrics", "run001/shard0000",
                                           "run001/shard0001", "run001/shard0002", "dataset"));
}

TEST_F(SupervisorTest, WithoutAnyRunThereIsNoDataset) {
  executor.before = [](const Task& task) {
    return task.kind == Task::Kind::simulate ? TaskResult{Outcome::crashed, 3, "boom", {}}
                                             : TaskResult{};
  };
  try {
    run_job(folder(), job, executor);
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("all 2 runs failed; run000/trace: boom"));
  }
  EXPECT_FALSE(folder().is_done({Task::Kind::collect}));
}

TEST_F(SupervisorTest, ReportsPaceAndRemainingTime) {
  executor.before = [](const Task&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return TaskResult{};
  };
  bool was_known = false;
  run_job(folder(), job, executor, [&](const JobProgress& progress) {
    if (progress.pace.images_per_s == 0) return;
    was_known = true;
    ASSERT_TRUE(progress.pace.remaining_s);
    EXPECT_GE(*progress.pace.remaining_s, 0);
    EXPECT_LT(progress.pace.images_per_s, 1 / 0.02);
  });
  EXPECT_TRUE(was_known);
}

TEST_F(SupervisorTest, RemovesLeftoversOfDeadWorkers) {
  const std::filesystem::path leftover =
      folder().path() / "work" / "run000" / "shard0000.tmp.12345.0" / "files";
  std::filesystem::create_directories(leftover);
  run_job(folder(), job, executor);
  EXPECT_FALSE(std::filesystem::exists(leftover.parent_path()));
}

TEST_F(SupervisorTest, RemovesLeftoversOfAWorkerThatDiedMeanwhile) {
  const JobFolder work = folder();
  std::vector<std::filesystem::path> leftovers;
  executor.before = [&](const Task& task) {
    leftovers.push_back(work.output_of(task).string() + ".tmp.12345.0");
    std::filesystem::create_directories(leftovers.back());
    return TaskResult{};
  };
  run_job(work, job, executor);
  EXPECT_EQ(leftovers.size(), executor.done().size());
  for (const std::filesystem::path& leftover : leftovers) {
    EXPECT_FALSE(std::filesystem::exists(leftover)) << leftover;
  }
}

TEST_F(SupervisorTest, DamagedOutputThatTheCollectorRemovesIsMadeAgain) {
  const JobFolder work = folder();
  const Task damaged{Task::Kind::measure, 0};
  int collected = 0;
  executor.before = [&](const Task& task) {
    if (task.kind != Task::Kind::collect || ++collected > 1) return TaskResult{};
    std::filesystem::remove_all(work.output_of(damaged));
    return TaskResult{Outcome::environment_error, 3, "damaged", {}};
  };
  run_job(work, job, executor);
  EXPECT_TRUE(work.is_done({Task::Kind::collect}));
  const std::vector<std::string> done = executor.done();
  EXPECT_EQ(std::count(done.begin(), done.end(), to_string(damaged)), 2);
}

TEST_F(SupervisorTest, AFolderHasOneSupervisorAtATime) {
  const JobFolder work = folder();
  executor.before = [&](const Task&) {
    EXPECT_THROW(run_job(work, job, executor), EnvironmentError);
    return TaskResult{};
  };
  run_job(work, job, executor);
  EXPECT_TRUE(work.is_done({Task::Kind::collect}));
}

TEST_F(SupervisorTest, AFailureNamesTheTaskAndTheReason) {
  executor.before = [](const Task& task) {
    return task.kind == Task::Kind::collect ? TaskResult{Outcome::crashed, 3, "boom", {}}
                                            : TaskResult{};
  };
  try {
    run_job(folder(), job, executor);
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("dataset: boom (after 3 attempts)"));
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
                                std::stop_token, const Share&) override {
      return std::vector<TaskResult>(tasks.size());
    }
  } liar;
  EXPECT_THROW(run_job(folder(), job, liar), EnvironmentError);
}

TEST_F(SupervisorTest, StoppingIsCancelled) {
  std::stop_source stop;
  executor.before = [&](const Task& task) {
    if (to_string(task) == "run000/shard0000") stop.request_stop();
    return TaskResult{};
  };
  EXPECT_THROW(run_job(folder(), job, executor, {}, stop.get_token()), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder().dataset()));
}

TEST_F(SupervisorTest, ProgressOnlyGrowsAndEndsComplete) {
  JobProgress last;
  run_job(folder(), job, executor, [&](const JobProgress& progress) {
    ASSERT_EQ(progress.runs.size(), 2U);
    for (std::size_t run = 0; run < last.runs.size(); ++run) {
      EXPECT_GE(progress.runs[run].images_done, last.runs[run].images_done);
      EXPECT_GE(progress.runs[run].stage, last.runs[run].stage);
      EXPECT_EQ(progress.runs[run].images_total, 3);
    }
    last = progress;
  });
  EXPECT_TRUE(last.shards.empty());
  for (const RunProgress& run : last.runs) {
    EXPECT_EQ(run.stage, Stage::finished);
    EXPECT_EQ(run.images_done, 3);
    EXPECT_EQ(run.simulated_s, 2);
  }
}

TEST_F(SupervisorTest, AFolderThatWasBarelyBegunIsTaken) {
  write_file_atomically(base.path() / "job" / "job.json.tmp.12345.0", "{");
  run_job(folder(), job, executor);
  EXPECT_FALSE(std::filesystem::exists(base.path() / "job" / "job.json.tmp.12345.0"));
  EXPECT_TRUE(std::filesystem::exists(folder().dataset()));
  write_file_atomically(base.path() / "file", "x");
  EXPECT_THROW(JobFolder::create(base.path() / "file", job), InputError);
}

// A job file of version 0.1 has deprecated names; it is still the same job.
TEST_F(SupervisorTest, AFolderOfAnEarlierVersionIsTakenUpAgain) {
  JobSpec orbit = job.spec();
  orbit.drones.at(0).mission.guidance.center = Eigen::Vector2d(4, 5);
  const JobFolder made = JobFolder::create(base.path() / "orbit", ResolvedJob(orbit));
  std::string text = read_file(made.job_file());
  const std::size_t at = text.find("\"center\"");
  ASSERT_NE(at, std::string::npos);
  write_file_atomically(made.job_file(), text.replace(at, 8, "\"centre\""));
  EXPECT_NO_THROW(JobFolder::create(made.path(), ResolvedJob(orbit)));
  EXPECT_EQ(to_json(made.read_job().spec()), to_json(orbit));
  orbit.drones.at(0).mission.guidance.center = Eigen::Vector2d(4, 6);
  EXPECT_THROW(JobFolder::create(made.path(), ResolvedJob(orbit)), InputError);
}

TEST_F(SupervisorTest, AFolderBelongsToOneJob) {
  folder();
  EXPECT_EQ(to_json(folder().read_job().spec()), to_json(job.spec()));
  JobSpec other = job.spec();
  other.seed = 99;
  EXPECT_THROW(JobFolder::create(base.path() / "job", ResolvedJob(other)), InputError);
  write_file_atomically(base.path() / "other" / "file", "x");
  EXPECT_THROW(JobFolder::create(base.path() / "other", job), InputError);
}

}  // namespace
}  // namespace throng::jobs
