// SlurmArrays with programs that pretend to be Slurm's: scripts in a folder at the front of PATH.
// Workers are started by them at once, as processes of this machine.
#include "jobs/queue/slurm/slurm_arrays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "jobs/queue/executors.h"
#include "jobs/queue/workers/attempts.h"
#include "tests/base/virtual_clock.h"
#include "tests/base/wait_until.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Keeps a line per task in $FAKE/queue/JOB_INDEX, in squeue's format.
constexpr const char* kSbatch = R"sh(#!/bin/sh
[ -e $FAKE/away ] && { echo "sbatch: error: Unable to contact slurm controller" >&2; exit 1; }
[ -e $FAKE/refusal ] && { echo "$*" >> $FAKE/refused; cat $FAKE/refusal >&2; exit 1; }
for word in "$@"; do case $word in
  --test-only) exit 0;;
  --job-name=*) name=${word#*=};;
  --array=*) last=${word##*-}; last=${last%%%*}
    [ -e $FAKE/most ] && [ $last -ge $(cat $FAKE/most) ] && { echo "$word" >> $FAKE/too_large
      echo "sbatch: error: Batch job submission failed: Invalid job array specification" >&2; exit 1; };;
  --wrap=*) script=${word#*=};;
esac; done
echo "$*" >> $FAKE/submitted
job=$(ls $FAKE/jobs | wc -l); job=$((job + 1)); mkdir $FAKE/jobs/$job
[ -e $FAKE/silent ] && { rm $FAKE/silent; exit 1; }
i=0; while [ $i -le $last ]; do
  export SLURM_ARRAY_TASK_ID=$i SLURMD_NODENAME=fake$((i % 2))
  line="$job|$i|%s|$SLURMD_NODENAME|None|%s|$name|\n"
  printf "$line" RUNNING 0 > $FAKE/queue/${job}_$i
  setsid $FAKE/bin/node "$script" "$line" $FAKE/queue/${job}_$i > /dev/null 2>&1 &
  i=$((i + 1))
done
# Until all have left the process group, which ends with this process.
i=0; while [ $i -le $last ]; do
  while [ ! -e $FAKE/started/${job}_$i ]; do sleep 0.01; done
  i=$((i + 1))
done
echo $job
)sh";
// A task on its node, from its begin to its end.
constexpr const char* kNode = R"sh(#!/bin/sh
: > $FAKE/started/${3##*/}
sh -c "$1"; code=$?
if [ -e $FAKE/end ]; then read state raw < $FAKE/end; rm $FAKE/end
elif [ $code = 0 ]; then state=COMPLETED raw=0
elif [ $code -gt 128 ]; then state=FAILED raw=$((code - 128))
else state=FAILED raw=$((code * 256)); fi
[ -e $3 ] && printf "$2" $state $raw > $3
)sh";
constexpr const char* kSqueue = R"sh(#!/bin/sh
[ -e $FAKE/away ] && { echo x >> $FAKE/looks; echo "slurm_load_jobs error: Unable to contact slurm controller" >&2; exit 1; }
cat $FAKE/queue/* 2>/dev/null; exit 0
)sh";
constexpr const char* kScancel = "#!/bin/sh\necho \"$*\" >> $FAKE/cancelled\n";
constexpr const char* kSacct =
    "#!/bin/sh\necho \"$*\" >> $FAKE/accounts\n"
    "echo 'Slurm accounting storage is disabled'; exit 1\n";
// begin_attempt() without the program: a worker that a test describes.
constexpr const char* kWorker = R"sh(#!/bin/sh
job=$2 array=$4
own=$job/attempts/$array/$SLURM_ARRAY_TASK_ID
task=$(sed "s/.*\"tasks\"://" $job/attempts/$array/array.json | tr '{' '\n' |
  sed -n "$((SLURM_ARRAY_TASK_ID + 2))p" | sed 's/.*"task":"\([^"]*\)".*/\1/')
mkdir $own/claimed || exit 3
say() { echo "$1" >> $own/messages; }
end() { say "{\"end\":{\"code\":$1,\"seconds\":0.5,\"published\":[]}}"; exit $1; }
begun() { echo x >> $job/begun; wc -l < $job/begun; }
)sh";

class SlurmArraysTest : public testing::Test {
 protected:
  SlurmArraysTest() {
    for (const char* name : {"bin", "queue", "jobs", "started"})
      fs::create_directories(fake.path() / name);
    install("sbatch", kSbatch);
    install("node", kNode);
    install("squeue", kSqueue);
    install("scancel", kScancel);
    install("scontrol", kScancel);
    install("sacct", kSacct);
    old_path = std::getenv("PATH");
    ::setenv("PATH", ((fake.path() / "bin").string() + ":" + old_path).c_str(), 1);
    ::setenv("FAKE", fake.path().c_str(), 1);
  }
  ~SlurmArraysTest() override { ::setenv("PATH", old_path.c_str(), 1); }

  void install(const std::string& name, const std::string& script) const {
    const fs::path file = fake.path() / "bin" / name;
    write_file_atomically(file, script);
    fs::permissions(file, fs::perms::owner_all);
  }

  SlurmOptions options_for(const std::string& script) const {
    install("worker", kWorker + script);
    SlurmOptions options;
    options.command = {(fake.path() / "bin" / "worker").string()};
    options.poll_s = 0.05;
    options.rest_s = 0.01;
    options.visibility_s = 1;
    return options;
  }

  std::vector<TaskResult> run(const std::string& script, int tasks = 1,
                              const std::stop_token& stop = {}) {
    SlurmArrays arrays(options_for(script));
    std::vector<Task> list;
    for (int i = 0; i < tasks; ++i) list.push_back({Task::Kind::simulate, i});
    Share share;
    share.on_wait = [this](const std::string& reason) { waits.push_back(reason); };
    const auto on_progress = [this](const Task&, const TaskProgress& progress) {
      steps.push_back(progress);
    };
    auto results = arrays.run(JobFolder(folder.path()), list, on_progress, stop, share);
    nodes = arrays.nodes_of(JobFolder(folder.path()));
    return results;
  }

  bool has_lines(const fs::path& file, std::ptrdiff_t count) const {
    return wait_until([&] {
      const std::string text = text_of(file);
      return std::count(text.begin(), text.end(), '\n') >= count;
    });
  }

  /// Whether Slurm's number of the folder's only array gets known.
  bool has_noted_number() const {
    return wait_until([&] {
      const JobFolder job(folder.path());
      const auto arrays = read_attempts(job);
      return arrays.size() == 1 && !noted_array_job(job, arrays[0].name).empty();
    });
  }

  std::string text_of(const fs::path& file) const {
    return fs::exists(file) ? read_file(file) : "";
  }

  TemporaryFolder fake;
  TemporaryFolder folder;
  std::string old_path;
  std::vector<std::string> waits;
  std::vector<TaskProgress> steps;
  std::vector<NodeWork> nodes;
};

TEST_F(SlurmArraysTest, DatasetsArePublishedHereAndNodesSeeNoCredentials) {
  ::setenv("AWS_SECRET_ACCESS_KEY", "hunter2", 1);
  SlurmArrays slurm(options_for("env > $job/node; end 0"),
                    {.command = {"/bin/sh", "-c", "cat > $2/here", "worker"}});
  const JobFolder job(folder.path());
  const std::vector<Task> simulate = {{Task::Kind::simulate}};
  const std::vector<Task> publish = {{Task::Kind::publish}};
  slurm.run(job, simulate, {}, {});
  const std::string submitted = read_file(fake.path() / "submitted");
  slurm.run(job, publish, {}, {});
  ::unsetenv("AWS_SECRET_ACCESS_KEY");
  EXPECT_EQ(read_file(fake.path() / "submitted"), submitted);
  EXPECT_THAT(read_file(job.path() / "here"), HasSubstr("AWS_SECRET_ACCESS_KEY=hunter2"));
  EXPECT_THAT(read_file(job.path() / "node"), testing::Not(HasSubstr("hunter2")));
}

TEST_F(SlurmArraysTest, AStageIsOneArray) {
  const auto results = run("say '{\"done\":1,\"total\":2}'; echo $task >> $job/tasks; end 0", 3);
  for (const TaskResult& result : results) {
    EXPECT_EQ(result.outcome, Outcome::succeeded) << result.message;
    EXPECT_EQ(result.attempts, 1);
  }
  EXPECT_THAT(text_of(fake.path() / "submitted"), HasSubstr("--array=0-2"));
  EXPECT_EQ(fs::exists(folder.path() / "attempts"), false) << "nothing is left";
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_THAT(steps[0].node, HasSubstr("fake"));
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_EQ(nodes[0].node, "fake0");
  EXPECT_EQ(nodes[0].done, 2);
  EXPECT_EQ(nodes[0].running, 0);
  EXPECT_EQ(nodes[1].done, 1);
  EXPECT_THAT(text_of(folder.path() / "logs/nodes.jsonl"), HasSubstr("\"task\":\"run002/trace\""));
}

// Thousands at once would keep the next stage waiting.
TEST_F(SlurmArraysTest, TheFolderOfATaskGoesWithItsEnd) {
  const auto results =
      run("[ $SLURM_ARRAY_TASK_ID = 0 ] && end 0\n"
          "i=0; while [ -e $job/attempts/$array/0 ]; do\n"
          "  i=$((i + 1)); [ $i -lt 1000 ] || end 2; sleep 0.01; done; end 0",
          2);
  EXPECT_EQ(results[1].outcome, Outcome::succeeded) << results[1].message;
}

TEST_F(SlurmArraysTest, ACrashIsTriedAgainAndThreeAreFinal) {
  EXPECT_EQ(run("[ $(begun) -lt 3 ] && kill -9 $$; end 0")[0].attempts, 3);
  fs::remove(folder.path() / "begun");
  const TaskResult result = run("begun; kill -9 $$")[0];
  EXPECT_EQ(result.outcome, Outcome::crashed);
  EXPECT_EQ(result.attempts, 3);
  EXPECT_THAT(result.message, HasSubstr("signal 9"));
}

TEST_F(SlurmArraysTest, AWrongJobIsNotTriedAgain) {
  const TaskResult result =
      run("begun; say '{\"error\":{\"kind\":\"input\",\"message\":\"bad mesh\",\"problems\":[]}}'; "
          "end 2")[0];
  EXPECT_EQ(result.outcome, Outcome::input_error);
  EXPECT_EQ(result.message, "bad mesh");
  EXPECT_EQ(text_of(folder.path() / "begun"), "x\n");
}

TEST_F(SlurmArraysTest, ANodeThatFailsCostsNoAttempt) {
  write_file_atomically(fake.path() / "end", "NODE_FAIL 0\n");
  const TaskResult result = run("[ $(begun) = 1 ] && exit 1; end 0")[0];
  EXPECT_EQ(result.outcome, Outcome::succeeded) << result.message;
  EXPECT_EQ(result.attempts, 1);
  EXPECT_EQ(text_of(folder.path() / "begun"), "x\nx\n");
  EXPECT_EQ(nodes.at(0).failed, 1);
  EXPECT_THAT(text_of(folder.path() / "logs/nodes.jsonl"), HasSubstr("\"outcome\":\"lost\""));
}

TEST_F(SlurmArraysTest, ATaskWithoutMemoryGetsMoreTheNextTime) {
  write_file_atomically(fake.path() / "end", "OUT_OF_MEMORY 0\n");
  SlurmOptions options = options_for("[ $(begun) = 1 ] && exit 1; end 0");
  options.memory_mib = 1000;
  SlurmArrays arrays(options);
  const std::vector<Task> tasks = {{Task::Kind::simulate, 0}};
  const auto results = arrays.run(JobFolder(folder.path()), tasks, {}, {});
  EXPECT_EQ(results[0].outcome, Outcome::succeeded) << results[0].message;
  EXPECT_EQ(results[0].attempts, 2);
  const std::string submitted = text_of(fake.path() / "submitted");
  EXPECT_THAT(submitted, HasSubstr("--mem=1000M"));
  EXPECT_THAT(submitted, HasSubstr("--mem=2000M"));
}

TEST_F(SlurmArraysTest, WhileTheControllerIsAwayNothingFails) {
  write_file_atomically(fake.path() / "away", "");
  std::jthread comes_back([this] {
    EXPECT_TRUE(has_lines(fake.path() / "looks", 3));
    fs::remove(fake.path() / "away");
  });
  EXPECT_EQ(run("end 0")[0].outcome, Outcome::succeeded);
  ASSERT_FALSE(waits.empty());
  EXPECT_THAT(waits[0], HasSubstr("Slurm's controller does not answer ("));
  EXPECT_EQ(waits.back(), "");
}

TEST_F(SlurmArraysTest, ARefusalIsSaidAndTriedAgain) {
  write_file_atomically(fake.path() / "refusal", "sbatch: error: Invalid account\n");
  std::jthread allows([this] {
    EXPECT_TRUE(has_lines(fake.path() / "refused", 3));
    fs::remove(fake.path() / "refusal");
  });
  const TaskResult result = run("end 0")[0];
  EXPECT_EQ(result.outcome, Outcome::succeeded);
  EXPECT_EQ(result.attempts, 1) << "a refusal is no attempt";
  ASSERT_FALSE(waits.empty());
  EXPECT_EQ(waits[0], "Slurm refuses the tasks: sbatch: error: Invalid account");
}

TEST_F(SlurmArraysTest, AClusterWithASmallerMaxArraySizeGetsSmallerArrays) {
  write_file_atomically(fake.path() / "most", "3");
  for (const TaskResult& result : run("end 0", 8)) {
    EXPECT_EQ(result.outcome, Outcome::succeeded) << result.message;
    EXPECT_EQ(result.attempts, 1);
  }
  EXPECT_EQ(text_of(fake.path() / "too_large"), "--array=0-7\n--array=0-3\n");
  EXPECT_THAT(text_of(fake.path() / "submitted"), testing::Not(HasSubstr("--array=0-3")));
  EXPECT_THAT(text_of(fake.path() / "submitted"), HasSubstr("--array=0-1"));
}

// By --requeue Slurm begins a task again under its number: it does so with the first start, and at
// no attempt's expense.
TEST_F(SlurmArraysTest, ATaskThatIsRequeuedBeginsAgainUnderItsNumber) {
  const auto line = [](const std::string& state, const std::string& node) {
    return "1|0|" + state + "|" + node + "|BeginTime|0|%s|\\n";
  };
  // The first start ends like a preempted one; the second begins once it has the right to.
  const std::string script =
      "q=$FAKE/queue/1_0\n"
      "[ $(begun) = 1 ] || end 0\n"
      "printf '" +
      line("RUNNING", "fake0") +
      "' throng-$array > $q\n"
      "while ! [ -e $FAKE/requeue ]; do sleep 0.01; done\n"
      "printf '" +
      line("PENDING", "") +
      "' throng-$array > $q\n"
      "i=0; while [ -e $own/claimed ] || ! [ -e $own ]; do\n"
      "  i=$((i + 1)); [ $i -lt 1000 ] || exit 75; sleep 0.01; done\n"
      "printf '" +
      line("RUNNING", "fake1") +
      "' throng-$array > $q\n"
      "SLURMD_NODENAME=fake1 exec $0 --job $job --array $array";
  SlurmArrays arrays(options_for(script));
  const JobFolder job(folder.path());
  const std::jthread requeues([&] {
    EXPECT_TRUE(wait_until([&] {
      const auto known = arrays.nodes_of(job);
      return !known.empty() && known[0].running == 1;
    }));
    write_file_atomically(fake.path() / "requeue", "");
  });
  const std::vector<Task> tasks = {{Task::Kind::simulate, 0}};
  const auto results = arrays.run(job, tasks, {}, {});
  EXPECT_EQ(results[0].outcome, Outcome::succeeded) << results[0].message;
  EXPECT_EQ(results[0].attempts, 1);
  EXPECT_EQ(text_of(folder.path() / "begun"), "x\nx\n");
  const std::string submitted = text_of(fake.path() / "submitted");
  EXPECT_EQ(std::count(submitted.begin(), submitted.end(), '\n'), 1) << "it keeps its place";
  EXPECT_THAT(text_of(folder.path() / "logs/nodes.jsonl"), HasSubstr("\"outcome\":\"lost\""));
}

// One question and one order for all tasks of an array, however many there are.
TEST_F(SlurmArraysTest, TasksThatSlurmForgetsAreAskedForAndGivenUpTogether) {
  install("forget", "#!/bin/sh\nrm -f $FAKE/queue/1_*\n");
  const std::string script =
      "[ $(begun) -gt 4 ] && end 0; while [ $(wc -l < $job/begun) -lt 4 ]; do sleep 0.01; done\n"
      "$FAKE/bin/forget; while [ -e $own ]; do sleep 0.01; done; exit 1";
  for (const TaskResult& result : run(script, 4)) {
    EXPECT_EQ(result.outcome, Outcome::succeeded) << result.message;
    EXPECT_EQ(result.attempts, 1);
  }
  EXPECT_EQ(text_of(fake.path() / "accounts"),
            "-n -P -X -j 1 -o JobID,State,ExitCode,NodeList,JobName\n");
  const std::string cancelled = text_of(fake.path() / "cancelled");
  EXPECT_EQ(std::count(cancelled.begin(), cancelled.end(), '\n'), 1);
  EXPECT_THAT(cancelled, HasSubstr(" 1_0 1_1 1_2 1_3\n"));
}

TEST_F(SlurmArraysTest, ALostAnswerOfSbatchRunsNothingTwice) {
  write_file_atomically(fake.path() / "silent", "");
  EXPECT_EQ(run("begun; end 0")[0].outcome, Outcome::succeeded);
  EXPECT_EQ(text_of(folder.path() / "begun"), "x\n");
  EXPECT_THAT(text_of(fake.path() / "cancelled"), HasSubstr("--name=throng-"));
}

TEST_F(SlurmArraysTest, CancelTakesTheRightToPublishAway) {
  install("scancel", kScancel + std::string("rm -f $FAKE/queue/*\n"));
  std::stop_source stop;
  std::jthread stops([&] {
    EXPECT_TRUE(has_lines(folder.path() / "begun", 2));
    EXPECT_TRUE(has_noted_number());
    stop.request_stop();
  });
  const auto results = run("begun; while [ -e $own ]; do sleep 0.05; done", 2, stop.get_token());
  for (const TaskResult& result : results) EXPECT_EQ(result.outcome, Outcome::cancelled);
  EXPECT_FALSE(fs::exists(folder.path() / "attempts"));
  EXPECT_THAT(text_of(fake.path() / "cancelled"), HasSubstr("--name=throng-"));
}

// The tasks go on when a server ends; the next one finds them.
TEST_F(SlurmArraysTest, TasksThatRunAreTakenUpAgain) {
  const SlurmOptions options =
      options_for("begun; while [ ! -e $job/go ]; do sleep 0.02; done; end 0");
  const std::vector<Task> tasks = {{Task::Kind::simulate, 0}, {Task::Kind::simulate, 1}};
  const JobFolder job(folder.path());
  for (const bool is_number_known : {true, false}) {
    {
      SlurmArrays first(options);
      std::stop_source stop;
      std::jthread stops([&] {
        EXPECT_TRUE(has_lines(folder.path() / "begun", 2));
        EXPECT_TRUE(has_noted_number());
        first.leave_tasks();
        stop.request_stop();
      });
      const auto left = first.run(job, tasks, {}, stop.get_token());
      EXPECT_EQ(left[0].outcome, Outcome::cancelled);
    }
    const auto arrays = read_attempts(job);
    ASSERT_EQ(arrays.size(), 1U);
    EXPECT_NE(noted_array_job(job, arrays[0].name), "");
    // It died before it knew the number.
    if (!is_number_known) fs::remove(array_folder(job, arrays[0].name) / "slurm_job");
    write_file_atomically(folder.path() / "go", "");
    SlurmArrays second(options);
    const auto results = second.run(job, tasks, {}, {});
    EXPECT_EQ(results[0].outcome, Outcome::succeeded) << results[0].message;
    EXPECT_EQ(results[1].outcome, Outcome::succeeded) << results[1].message;
    EXPECT_EQ(text_of(folder.path() / "begun"), "x\nx\n") << "each ran once";
    EXPECT_FALSE(fs::exists(folder.path() / "attempts"));
    fs::remove(folder.path() / "go");
    fs::remove(folder.path() / "begun");
  }
}

// A controller that has lost its state gives the same numbers to others.
TEST_F(SlurmArraysTest, ANumberThatCameAgainIsAnothersJob) {
  AttemptArray lost;
  lost.attempts = {{"run000/trace", 1}};
  const JobFolder job(folder.path());
  create_attempts(job, lost);
  note_array_job(job, lost.name, "77");
  write_file_atomically(fake.path() / "queue/77_0", "77|0|RUNNING|fake0|None|0|throng-others|\n");
  const TaskResult result = run("begun; end 0")[0];
  EXPECT_EQ(result.outcome, Outcome::succeeded);
  EXPECT_EQ(text_of(folder.path() / "begun"), "x\n");
  EXPECT_THAT(text_of(fake.path() / "cancelled"),
              HasSubstr("--name=throng-" + lost.name + " 77_0"));
}

TEST_F(SlurmArraysTest, AnArrayThatNeverReachedSlurmIsSubmittedAgain) {
  AttemptArray lost;
  lost.attempts = {{"run000/trace", 1}};
  create_attempts(JobFolder(folder.path()), lost);
  const TaskResult result = run("begun; end 0")[0];
  EXPECT_EQ(result.outcome, Outcome::succeeded);
  EXPECT_EQ(result.attempts, 1);
  EXPECT_EQ(text_of(folder.path() / "begun"), "x\n");
}

TEST_F(SlurmArraysTest, ASilentWorkerIsReplaced) {
  // The first one says nothing until it has lost its right to publish.
  SlurmOptions options =
      options_for("[ $(begun) = 1 ] && { while [ -e $own ]; do sleep 0.05; done; exit 1; }; end 0");
  VirtualClock clock;
  options.now = clock.now();
  options.rest_s = 0;
  SlurmArrays arrays(options);
  const JobFolder job(folder.path());
  std::size_t begun_within_lease = 0;
  const std::jthread time([&] {
    EXPECT_TRUE(has_lines(folder.path() / "begun", 1));
    EXPECT_TRUE(wait_until([&] {
      const auto known = arrays.nodes_of(job);
      return !known.empty() && known[0].running == 1;
    }));
    clock.advance(std::chrono::seconds(120));
    const int asked = clock.asked();
    EXPECT_TRUE(wait_until([&] { return clock.asked() >= asked + 5; }));  // some looks
    begun_within_lease = text_of(folder.path() / "begun").size();
    clock.advance(std::chrono::milliseconds(1));
  });
  const std::vector<Task> tasks = {{Task::Kind::simulate, 0}};
  const auto results = arrays.run(job, tasks, {}, {});
  EXPECT_EQ(begun_within_lease, 2U) << "one line";
  EXPECT_EQ(results[0].outcome, Outcome::succeeded) << results[0].message;
  EXPECT_EQ(results[0].attempts, 2);
}

TEST_F(SlurmArraysTest, OptionsAreCheckedFirst) {
  EXPECT_EQ(check_slurm({}), "");
  write_file_atomically(fake.path() / "away", "");
  EXPECT_THAT(check_slurm({}), HasSubstr("Unable to contact"));
  fs::remove(fake.path() / "away");
  write_file_atomically(fake.path() / "refusal",
                        "allocation failure: Invalid partition name specified\n");
  try {
    check_slurm({});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("Invalid partition name specified"));
  }
}

TEST(Executors, HaveNames) {
  EXPECT_STREQ(executor_kinds()[0].name, "local");
  EXPECT_STREQ(executor_kind("slurm").name, "slurm");
  EXPECT_THROW(executor_kind("kubernetes"), InputError);
}

}  // namespace
}  // namespace throng::jobs
