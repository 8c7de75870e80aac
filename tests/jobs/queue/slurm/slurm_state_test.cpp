#include "jobs/queue/slurm/slurm_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "jobs/queue/slurm/slurm_submission.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

// Printed by squeue 22.05.8 of a cluster of two nodes; names of others' jobs may hold anything.
constexpr const char* kQueue =
    "1|7|PENDING||Resources|0|throng-abc|\n"
    "1|0|RUNNING|node1|None|0|throng-abc|\n"
    "1|1|FAILED|node1|NonZeroExitCode|768|throng-abc|\n"
    "1|2|FAILED|node2|JobLaunchFailure|9|throng-abc|\n"
    "12|N/A|RUNNING|node2|None|0|somebody's|\n"
    "13|4|RUNNING|node2|None|0|their throng-x|\n"
    "slurm_load_jobs error: something else\n";

TEST(SlurmState, TheQueueHoldsOurTasksOnly) {
  const std::vector<SlurmTask> tasks = read_queue(kQueue, "throng-");
  ASSERT_EQ(tasks.size(), 4U);
  EXPECT_EQ(tasks[0].job, "1");
  EXPECT_EQ(tasks[0].index, 7);
  EXPECT_EQ(tasks[0].name, "throng-abc");
  EXPECT_EQ(tasks[0].node, "");
  EXPECT_EQ(tasks[0].reason, "Resources");
  EXPECT_EQ(interpret_fate(tasks[0]), SlurmFate::waiting);
  EXPECT_EQ(tasks[1].node, "node1");
  EXPECT_EQ(interpret_fate(tasks[1]), SlurmFate::running);
  EXPECT_EQ(tasks[2].status.code, 3);
  EXPECT_EQ(tasks[2].status.signal, 0);
  EXPECT_EQ(tasks[3].status.code, 0);
  EXPECT_EQ(tasks[3].status.signal, SIGKILL);
  EXPECT_TRUE(read_queue("", "throng-").empty());
}

TEST(SlurmState, TheAccountingKnowsStateStatusAndNode) {
  const auto tasks = read_accounting(
      "7_3|CANCELLED by 1000|0:15|node2|throng-a|\n"
      "7_4|FAILED|3:0|node1|throng-a|\n"
      "7_5|FAILED|3:0|node1|throng-b|\n",
      "throng-a");
  ASSERT_EQ(tasks.size(), 2U) << "the number came again for another's job";
  EXPECT_EQ(tasks.at(3).state, "CANCELLED");
  EXPECT_EQ(tasks.at(3).status.signal, SIGTERM);
  EXPECT_EQ(tasks.at(3).node, "node2");
  EXPECT_EQ(tasks.at(4).status.code, 3);
  EXPECT_TRUE(read_accounting("", "throng-a").empty());
  EXPECT_TRUE(read_accounting("Slurm accounting storage is disabled\n", "throng-a").empty());
}

TEST(SlurmState, TheAccountingHasOneLineForTasksThatWait) {
  const auto indices = [](const std::string& job) {
    std::vector<int> found;
    for (const auto& [index, task] :
         read_accounting(job + "|PENDING|0:0|None assigned|throng-a|\n", "throng-a")) {
      EXPECT_EQ(task.job, "7");
      EXPECT_EQ(task.index, index);
      EXPECT_EQ(interpret_fate(task), SlurmFate::waiting);
      found.push_back(index);
    }
    return found;
  };
  EXPECT_THAT(indices("7_[5-7,9%4]"), testing::ElementsAre(5, 6, 7, 9));
  EXPECT_THAT(indices("7_[0-1]"), testing::ElementsAre(0, 1));
  EXPECT_THAT(indices("7_[2]"), testing::ElementsAre(2));
  EXPECT_EQ(indices("7_[5-999%100]").size(), 995U);
  EXPECT_THAT(indices("7"), testing::IsEmpty());
  EXPECT_THAT(indices("7_[]"), testing::IsEmpty());
  EXPECT_THAT(indices("7_[0-99999999999]"), testing::IsEmpty());
}

TEST(SlurmState, ASubmissionGivesANumber) {
  EXPECT_EQ(read_submission("17\n"), "17");
  EXPECT_EQ(read_submission("17;cluster\n"), "17");
  EXPECT_EQ(read_submission("sbatch: warning: can't run 1 processes on 2 nodes\n18\n"), "18");
  EXPECT_EQ(read_submission("sbatch: error: invalid partition specified: nope\n"), "");
}

TEST(SlurmState, AControllerThatIsAwayRefusesNothing) {
  for (const char* text :
       {"slurm_load_jobs error: Unable to contact slurm controller (connect failure)\n",
        "sbatch: error: Batch job submission failed: Socket timed out on send/recv operation\n",
        "sbatch: error: Slurm temporarily unable to accept job, sleeping and retrying\n",
        "squeue: no answer within 30 s\n",
        "sbatch: error: If munged is up, restart with --num-threads=10\nsbatch: error: Munge "
        "encode "
        "failed: Failed to connect to \"/run/munge\": No such file or directory\n"}) {
    EXPECT_TRUE(is_controller_away(text)) << text;
  }
  EXPECT_FALSE(is_controller_away("allocation failure: Invalid partition name specified\n"));
  EXPECT_FALSE(
      is_controller_away("sbatch: error: Invalid generic resource (gres) specification\n"));
}

SlurmTask in_state(const char* state, ExitStatus status = {}, const char* reason = "None") {
  SlurmTask task{"1", 0, "throng-a", state, "node1", reason};
  task.status = status;
  return task;
}

TaskResult result_in(const char* state, ExitStatus status = {}) {
  return result_of_slurm(in_state(state, status), {}, "/nowhere.log");
}

TEST(SlurmState, StatesBecomeOutcomes) {
  EXPECT_EQ(result_in("COMPLETED").outcome, Outcome::succeeded);
  EXPECT_EQ(result_in("FAILED", {2, 0}).outcome, Outcome::input_error);
  EXPECT_EQ(result_in("FAILED", {3, 0}).outcome, Outcome::environment_error);
  EXPECT_EQ(result_in("FAILED", {4, 0}).outcome, Outcome::out_of_memory);
  EXPECT_EQ(result_in("FAILED", {70, 0}).outcome, Outcome::crashed);
  EXPECT_EQ(result_in("FAILED", {0, SIGSEGV}).outcome, Outcome::crashed);
  EXPECT_EQ(result_in("OUT_OF_MEMORY", {0, 125}).outcome, Outcome::out_of_memory);
  EXPECT_EQ(result_in("TIMEOUT").outcome, Outcome::timed_out);
  EXPECT_EQ(result_in("DEADLINE").outcome, Outcome::timed_out);
  EXPECT_EQ(result_in("CANCELLED").outcome, Outcome::environment_error);
  EXPECT_EQ(result_in("NODE_FAIL").message, "lost on node node1 (NODE_FAIL, None)");
}

TEST(SlurmState, FailuresOfTheClusterCostNoAttempt) {
  for (const char* state : {"NODE_FAIL", "BOOT_FAIL", "PREEMPTED", "REQUEUE_HOLD"}) {
    EXPECT_TRUE(is_blameless(interpret_fate(in_state(state)))) << state;
  }
  EXPECT_TRUE(is_blameless(interpret_fate(in_state("FAILED", {0, SIGTERM}))));
  EXPECT_TRUE(is_blameless(interpret_fate(in_state("FAILED", {75, 0}))))
      << "begun by another process";
  EXPECT_TRUE(is_blameless(interpret_fate(in_state("PENDING", {}, "launch failed requeued held"))));
  for (const char* state :
       {"COMPLETED", "FAILED", "TIMEOUT", "OUT_OF_MEMORY", "CANCELLED", "RUNNING", "PENDING"}) {
    EXPECT_FALSE(is_blameless(interpret_fate(in_state(state)))) << state;
  }
}

TEST(SlurmState, AStateOfALaterVersionIsNoEnd) {
  EXPECT_EQ(interpret_fate(in_state("EXPEDITING")), SlurmFate::running);
}

TEST(SlurmState, WorkersSayMoreThanSlurm) {
  const WorkerError error{"input", "the mesh is broken", {{"yard.json", "/x", "a", "b"}}};
  const TaskResult result = result_of_slurm(in_state("FAILED", {2, 0}), error, "/nowhere.log");
  EXPECT_EQ(result.message, "the mesh is broken");
  EXPECT_EQ(result.problems.size(), 1U);
}

// --- what is asked of Slurm

TEST(SlurmSubmission, NeedsComeFromTheEstimate) {
  const SlurmOptions options;
  const Task render{Task::Kind::render, 0, 0};
  EXPECT_EQ(slurm_need(render, 0, 0, options).memory_mib, 0) << "the partition's default";
  EXPECT_EQ(slurm_need(render, 900, 0, options).memory_mib, 1024 + 512);
  EXPECT_EQ(slurm_need(render, 900, 1, options).memory_mib, 2 * (1024 + 512)) << "after it ran out";
  EXPECT_EQ(slurm_need(render, 900, 0, options),
            slurm_need({Task::Kind::render, 1, 7}, 1000, 0, options));
  SlurmOptions least;
  least.memory_mib = 8000;
  EXPECT_EQ(slurm_need(render, 900, 0, least).memory_mib, 8000);
  EXPECT_NE(slurm_need(render, 900, 0, options),
            slurm_need({Task::Kind::measure, 0}, 900, 0, options));
}

TEST(SlurmSubmission, HigherPrioritiesAreLessNice) {
  EXPECT_EQ(nice_value(100), 0);
  EXPECT_EQ(nice_value(0), 100);
  EXPECT_EQ(nice_value(-100), 200);
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST(SlurmSubmission, AnArrayIsNeverRestartedBySlurm) {
  SlurmOptions options;
  options.command = {"/opt/it's/throng", "worker"};
  options.partition = "gpu";
  options.account = "lab";
  options.time = "2:00:00";
  options.gres = "gpu:1";
  options.at_once = 8;
  options.more = {"--qos=low"};
  const JobFolder folder("/shared/50% done");
  const auto words = submission_words(folder, "00ff", 40, {1536, 1024, true}, 90, options);
  for (const char* word : {"sbatch", "--parsable", "--no-requeue", "--job-name=throng-00ff",
                           "--array=0-39%8", "--nice=90", "--partition=gpu", "--account=lab",
                           "--time=2:00:00", "--mem=1536M", "--gres=gpu:1", "--cpus-per-task=1",
                           "--qos=low", "--output=/shared/50%% done/attempts/00ff/out/%a.log"}) {
    EXPECT_TRUE(holds(words, word)) << word;
  }
  EXPECT_EQ(words.back(),
            "--wrap=exec '/opt/it'\\''s/throng' 'worker' --job '/shared/50% done' --array 00ff");
  const auto others = submission_words(folder, "00ff", 1, {0, 0, false}, 100, options);
  EXPECT_TRUE(holds(others, "--array=0-0%8"));
  EXPECT_FALSE(holds(others, "--gres=gpu:1")) << "only tasks that render need the GPU";
}

}  // namespace
}  // namespace throng::jobs
