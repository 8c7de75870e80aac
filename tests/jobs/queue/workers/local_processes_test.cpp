#include "jobs/queue/workers/local_processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <thread>

#include "tests/base/virtual_clock.h"
#include "tests/base/wait_until.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

// Workers are shell scripts that get "--job FOLDER --task NAME".
class LocalProcessesTest : public testing::Test {
 protected:
  std::vector<TaskResult> run(const std::string& script, int tasks = 1, int workers = 2,
                              std::stop_token stop = {}) {
    std::vector<Task> list;
    list.reserve(static_cast<std::size_t>(tasks));
    for (int i = 0; i < tasks; ++i) list.push_back({Task::Kind::simulate, i});
    LocalProcessesOptions options;
    options.command = {"/bin/sh", "-c", "job=$2 task=$4; " + script, "worker"};
    options.workers = workers;
    options.grace_s = 0.3;
    options.rest_s = rest_s;
    options.lease_s = lease_s;
    options.now = now;
    options.max_task_s = max_task_s;
    LocalProcesses processes(options);
    return processes.run(
        JobFolder(folder.path()), list,
        [&](const Task& task, const TaskProgress& progress) {
          reported[task.run].push_back(progress.done);
          if (on_progress) on_progress(progress);
        },
        std::move(stop));
  }

  int count_lines(const std::string& name) const {
    std::ifstream file(folder.path() / name);
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    return lines;
  }

  std::string last_line(const std::string& name) const {
    std::ifstream file(folder.path() / name);
    std::string last;
    for (std::string line; std::getline(file, line);) last = line;
    return last;
  }

  bool has_lines(const std::string& name, int count) const {
    return wait_until([&] { return count_lines(name) >= count; });
  }

  TemporaryFolder folder;
  std::map<int, std::vector<double>> reported;
  std::function<void(const TaskProgress&)> on_progress;
  SteadyNow now = &steady_now;
  double lease_s = 60;
  double max_task_s = 0;
  double rest_s = 0.01;
};

/// Sets a variable of this process for the time of a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

TEST_F(LocalProcessesTest, OnlyTheOneThatPublishesGetsCredentials) {
  const Variable secret("AWS_SECRET_ACCESS_KEY", "hunter2");
  const Variable profile("AWS_SHARED_CREDENTIALS_FILE", "/srv/keys");
  LocalProcessesOptions options;
  options.command = {"/bin/sh", "-c", "env > $2/$4.env; cat > $2/$4.in", "worker"};
  LocalProcesses processes(options);
  const auto environment_of = [&](const Task& task) {
    std::filesystem::create_directories((folder.path() / to_string(task)).parent_path());
    const std::array tasks = {task};
    processes.run(JobFolder(folder.path()), tasks, {}, {});
    return read_file(folder.path() / (to_string(task) + ".env"));
  };
  const auto input_of = [&](const Task& task) {
    return read_file(folder.path() / (to_string(task) + ".in"));
  };
  EXPECT_THAT(environment_of({Task::Kind::publish}), testing::Not(HasSubstr("AWS_")));
  EXPECT_THAT(input_of({Task::Kind::publish}), HasSubstr("AWS_SECRET_ACCESS_KEY=hunter2"));
  for (const Task::Kind kind : {Task::Kind::simulate, Task::Kind::measure, Task::Kind::render,
                                Task::Kind::collect, Task::Kind::calibrate, Task::Kind::report,
                                Task::Kind::study_run, Task::Kind::study_report}) {
    const std::string environment = environment_of({kind});
    EXPECT_THAT(environment, testing::Not(HasSubstr("AWS_")));
    EXPECT_THAT(environment, testing::Not(HasSubstr("hunter2")));
    EXPECT_THAT(environment, HasSubstr("THRONG_PRIVATE_CREDENTIALS=/srv/keys\n"));
    EXPECT_EQ(input_of({kind}), "");
  }
}

TEST_F(LocalProcessesTest, EveryTaskRunsOnce) {
  const auto results = run("echo $task >> $job/ran", 5);
  EXPECT_EQ(results.size(), 5U);
  for (const TaskResult& result : results) {
    EXPECT_EQ(result.outcome, Outcome::succeeded);
    EXPECT_EQ(result.attempts, 1);
  }
  EXPECT_EQ(count_lines("ran"), 5);
}

TEST_F(LocalProcessesTest, ReportsProgressAndIgnoresNoise) {
  run(R"(echo 'libGL: hello'; echo '{"done":1,"total":3}'; echo '[1]'; echo '{"done":3,"total":3}')");
  EXPECT_THAT(reported[0], ElementsAre(1, 3));
}

TEST_F(LocalProcessesTest, ACrashIsRetriedAndForgotten) {
  const auto results = run("echo x >> $job/tries; [ $(wc -l < $job/tries) -ge 3 ] || kill -9 $$");
  EXPECT_EQ(results[0].outcome, Outcome::succeeded);
  EXPECT_EQ(results[0].attempts, 3);
}

/// Lowers a limit of this process for as long as it exists.
class Lowered {
 public:
  Lowered(decltype(RLIMIT_NOFILE) what, rlim_t value) : what_(what) {
    ::getrlimit(what_, &before_);
    const rlimit lower{value, before_.rlim_max};
    ::setrlimit(what_, &lower);
  }
  ~Lowered() { ::setrlimit(what_, &before_); }
  Lowered(const Lowered&) = delete;
  Lowered& operator=(const Lowered&) = delete;

 private:
  decltype(RLIMIT_NOFILE) what_;
  rlimit before_{};
};

TEST_F(LocalProcessesTest, ATaskWaitsAsLongAsTheMachineHasNoRoomForItsWorker) {
  std::vector<std::string> reasons;
  LocalProcessesOptions options;
  options.command = {"/bin/sh", "-c", "echo x >> $2/ran", "worker"};
  options.rest_s = 0.05;
  LocalProcesses processes(options);
  auto lowered = std::make_unique<Lowered>(RLIMIT_NOFILE, 0);  // no further file can be opened
  Share share;
  share.on_wait = [&](const std::string& reason) { reasons.push_back(reason); };
  // It is asked for before each try.
  int tries = 0;
  share.memory_mib = [&](const Task&) {
    if (++tries == 5) lowered.reset();
    return 0;
  };
  const std::vector<Task> tasks = {{Task::Kind::simulate, 0}};
  const auto results = processes.run(JobFolder(folder.path()), tasks, {}, {}, share);
  EXPECT_EQ(results[0].outcome, Outcome::succeeded) << results[0].message;
  EXPECT_EQ(results[0].attempts, 1) << "only what was begun counts";
  EXPECT_EQ(tries, 5);
  EXPECT_EQ(count_lines("ran"), 1);
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_THAT(reasons[0], HasSubstr("Too many open files"));
  EXPECT_EQ(reasons[1], "");
}

TEST_F(LocalProcessesTest, AWorkerInheritsNoOpenFile) {
  std::array<int, 2> pair{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair.data()), 0);  // as a library's
  const auto results = run("ls /proc/self/fd > $job/open");
  ::close(pair[0]);
  ::close(pair[1]);
  EXPECT_EQ(results[0].outcome, Outcome::succeeded);
  std::ifstream file(folder.path() / "open");
  for (int number = 0; file >> number;) EXPECT_LE(number, 3);  // 3 is the folder that ls reads
}

TEST_F(LocalProcessesTest, ThreeCrashesAreFinalAndSayWhy) {
  const auto results = run("echo last words >&2; kill -SEGV $$");
  EXPECT_EQ(results[0].outcome, Outcome::crashed);
  EXPECT_EQ(results[0].attempts, 3);
  EXPECT_THAT(results[0].message, HasSubstr("signal 11"));
  EXPECT_THAT(results[0].message, HasSubstr("last words"));
}

TEST_F(LocalProcessesTest, FailuresOfTheMachineAreRetried) {
  const auto results = run(
      R"(echo x >> $job/tries; echo '{"error":{"kind":"environment","message":"disk full"}}'; exit 3)");
  EXPECT_EQ(results[0].outcome, Outcome::environment_error);
  EXPECT_EQ(results[0].message, "disk full");
  EXPECT_EQ(count_lines("tries"), 3);
}

TEST_F(LocalProcessesTest, InputErrorsAreNotRetried) {
  const auto results = run(
      R"(echo x >> $job/tries
         echo '{"error":{"kind":"input","message":"m","problems":[{"where":"/runs","found":"0","expected":"1"}]}}'
         exit 2)");
  EXPECT_EQ(results[0].outcome, Outcome::input_error);
  ASSERT_EQ(results[0].problems.size(), 1U);
  EXPECT_EQ(results[0].problems[0].where, "/runs");
  EXPECT_EQ(count_lines("tries"), 1);
}

TEST_F(LocalProcessesTest, AWrongJobEndsAllTasks) {
  const auto results = run("[ $task = run001/trace ] && exit 2; exec sleep 600", 3);
  EXPECT_EQ(results[0].outcome, Outcome::cancelled);
  EXPECT_EQ(results[1].outcome, Outcome::input_error);
  EXPECT_EQ(results[2].outcome, Outcome::cancelled);
}

TEST_F(LocalProcessesTest, ATaskThatFailsForGoodEndsThoseOfItsRunOnly) {
  const std::vector<Task> tasks = {{Task::Kind::render, 0, 0},
                                   {Task::Kind::render, 0, 1},
                                   {Task::Kind::render, 1, 0},
                                   {Task::Kind::render, 0, 2}};
  LocalProcessesOptions options;
  options.command = {"/bin/sh", "-c",
                     "case $4 in run000/shard0000) exit 3;; run000/shard0001) exec sleep 600;; "
                     "esac; sleep 0.3",
                     "worker"};
  options.workers = 2;
  options.attempts = 2;
  options.grace_s = 0.3;
  options.rest_s = 0.01;
  LocalProcesses processes(options);
  const auto results = processes.run(JobFolder(folder.path()), tasks, {}, {});
  EXPECT_EQ(results[0].outcome, Outcome::environment_error);
  EXPECT_EQ(results[0].attempts, 2);
  EXPECT_EQ(results[1].outcome, Outcome::cancelled);
  EXPECT_EQ(results[2].outcome, Outcome::succeeded);
  EXPECT_NE(results[3].outcome, Outcome::environment_error);
}

TEST_F(LocalProcessesTest, AWorkerThatIsSilentTooLongIsReplaced) {
  VirtualClock clock;
  now = clock.now();
  rest_s = 0;
  int tries_within_lease = 0;
  const std::jthread time([&] {
    if (!has_lines("tries", 1)) return;
    clock.advance(60s);
    const int asked = clock.asked();
    wait_until([&] { return clock.asked() > asked + 20; });  // some rounds
    tries_within_lease = count_lines("tries");
    clock.advance(1ms);
  });
  const auto results =
      run("echo x >> $job/tries; [ $(wc -l < $job/tries) -ge 2 ] || exec sleep 600");
  EXPECT_EQ(tries_within_lease, 1);
  EXPECT_EQ(results[0].outcome, Outcome::succeeded);
  EXPECT_EQ(results[0].attempts, 2);
}

TEST_F(LocalProcessesTest, SignsOfLifeKeepAWorker) {
  VirtualClock clock;
  now = clock.now();
  on_progress = [&](const TaskProgress& progress) {
    clock.advance(59s);
    write_file_atomically(folder.path() / std::to_string(std::lround(progress.done)), "");
  };
  const auto results =
      run("for i in 1 2 3 4 5 6 7 8; do echo '{\"done\":'$i',\"total\":8}'; "
          "while [ ! -e $job/$i ]; do sleep 0.01; done; done");
  EXPECT_EQ(reported[0].size(), 8U);
  EXPECT_EQ(results[0].outcome, Outcome::succeeded);
  EXPECT_EQ(results[0].attempts, 1);
}

TEST_F(LocalProcessesTest, AHangingWorkerIsNamedAsSuch) {
  lease_s = 0.2;
  auto results = run("kill -STOP $$");
  EXPECT_EQ(results[0].outcome, Outcome::timed_out);
  EXPECT_THAT(results[0].message, HasSubstr("timed out: no sign of life for 0.2 s"));
  lease_s = 60;
  max_task_s = 0.2;
  results = run("while :; do echo '{}'; sleep 0.05; done");
  EXPECT_EQ(results[0].outcome, Outcome::timed_out);
  EXPECT_EQ(results[0].attempts, 3);
  EXPECT_THAT(results[0].message, HasSubstr("the task took longer than 0.2 s"));
}

TEST_F(LocalProcessesTest, OutOfMemoryIsNamedAsSuch) {
  const auto results =
      run(R"(echo '{"error":{"kind":"environment","message":"out of memory: x"}}'; exit 4)");
  EXPECT_EQ(results[0].outcome, Outcome::out_of_memory);
  EXPECT_THAT(results[0].message, HasSubstr("out of memory"));
}

TEST_F(LocalProcessesTest, ATaskRestsBeforeItIsTriedAgain) {
  VirtualClock clock;
  now = clock.now();
  rest_s = 10;
  std::vector<int> tries;  // before the end of each rest
  const std::jthread time([&] {
    for (const auto rest : {10s, 40s}) {
      if (!has_lines("tries", static_cast<int>(tries.size()) + 1)) return;
      // It rests once its process has been collected.
      const std::string pid = last_line("tries");
      if (!wait_until([&] { return !std::filesystem::exists("/proc/" + pid); })) return;
      for (const auto part : {SteadyTime::duration(rest - 1ms), SteadyTime::duration(1ms)}) {
        const int asked = clock.asked();
        wait_until([&] { return clock.asked() > asked + 20; });
        if (part == 1ms) tries.push_back(count_lines("tries"));
        clock.advance(part);
      }
    }
  });
  const auto results = run("echo $$ >> $job/tries; exit 3");
  EXPECT_THAT(tries, ElementsAre(1, 2));
  EXPECT_EQ(results[0].attempts, 3);
}

TEST_F(LocalProcessesTest, CancelEndsTheWholeTreeEvenIfItIgnoresSigterm) {
  std::stop_source stop;
  const std::jthread canceller([&] {
    EXPECT_TRUE(has_lines("children", 4));
    stop.request_stop();
  });
  const auto results =
      run("trap '' TERM; (trap '' TERM; echo $$ >> $job/children; sleep 600) & echo $! >> "
          "$job/children; "
          "wait",
          2, 2, stop.get_token());
  EXPECT_EQ(results[0].outcome, Outcome::cancelled);
  EXPECT_EQ(results[1].outcome, Outcome::cancelled);
  std::ifstream children(folder.path() / "children");
  for (pid_t pid = 0; children >> pid;) {
    // A killed grandchild may be an unreaped zombie of init for a moment.
    const auto gone = [&] {
      std::ifstream status("/proc/" + std::to_string(pid) + "/stat");
      std::string id;
      std::string name;
      std::string state = "gone";
      status >> id >> name >> state;
      return state == "gone" || state == "Z";
    };
    EXPECT_TRUE(wait_until(gone)) << pid;
  }
}

TEST_F(LocalProcessesTest, AStoppedTokenStartsNothing) {
  std::stop_source stop;
  stop.request_stop();
  const auto results = run("echo x >> $job/ran", 3, 2, stop.get_token());
  for (const TaskResult& result : results) EXPECT_EQ(result.outcome, Outcome::cancelled);
  EXPECT_EQ(count_lines("ran"), 0);
}

TEST_F(LocalProcessesTest, NoMoreWorkersThanAsked) {
  run("mkdir $job/one || echo two >> $job/clash; sleep 0.05; rmdir $job/one", 4, 1);
  EXPECT_EQ(count_lines("clash"), 0);
}

TEST_F(LocalProcessesTest, WorkersKnowTheirSupervisorAndShareTheCores) {
  run("echo $THRONG_SUPERVISOR_PID $LP_NUM_THREADS >> $job/env", 2);
  std::ifstream file(folder.path() / "env");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, std::to_string(::getpid()) + " 0");
}

TEST_F(LocalProcessesTest, AHigherPriorityGoesAheadAtTheBordersOfTasks) {
  VirtualClock clock;
  LocalProcessesOptions options;
  options.command = {"/bin/sh", "-c", "echo $2 $4 >> $0; while [ ! -e $0.go ]; do sleep 0.01; done",
                     (folder.path() / "order").string()};
  options.workers = 1;
  options.now = clock.now();  // a claim on a worker grows old only with time
  LocalProcesses processes(options);
  const auto run_job = [&](const std::string& name, int count, int priority) {
    std::vector<Task> tasks;
    for (int i = 0; i < count; ++i) tasks.push_back({Task::Kind::simulate, i});
    Share share{.owner = name, .job = name};
    int asked = 0;
    share.priority = [&] {
      // When the higher one asks again, it has been refused once, and waits.
      if (priority > 0 && ++asked == 2) write_file_atomically(folder.path() / "order.go", "");
      return priority;
    };
    processes.run(JobFolder(folder.path() / name), tasks, {}, {}, share);
  };
  {
    const std::jthread low([&] { run_job("low", 12, 0); });
    ASSERT_TRUE(has_lines("order", 1));
    run_job("high", 4, 10);
  }
  std::ifstream file(folder.path() / "order");
  std::string order;
  for (std::string line; std::getline(file, line);) {
    order += line.find("/high ") != std::string::npos ? 'h' : 'l';
  }
  EXPECT_EQ(order, "lhhhhlllllllllll");
}

TEST_F(LocalProcessesTest, CallsShareTheWorkers) {
  LocalProcessesOptions options;
  options.command = {"/bin/sh", "-c", "mkdir $0 || echo two >> $0.clash; sleep 0.05; rmdir $0",
                     (folder.path() / "one").string()};
  options.workers = 1;
  LocalProcesses processes(options);
  {
    std::vector<std::jthread> jobs;
    for (int i = 0; i < 4; ++i) {
      jobs.emplace_back([&, i] {
        const std::vector<Task> tasks = {{Task::Kind::simulate, 0}, {Task::Kind::simulate, 1}};
        const std::string name = "j" + std::to_string(i);
        for (const TaskResult& result :
             processes.run(JobFolder(folder.path() / name), tasks, {}, {}, {.job = name})) {
          EXPECT_EQ(result.outcome, Outcome::succeeded);
        }
      });
    }
  }
  EXPECT_EQ(count_lines("one.clash"), 0);
}

TEST_F(LocalProcessesTest, AProgramThatIsNotThereIsTheMachinesFault) {
  LocalProcessesOptions options;
  options.command = {"/nonexistent/throng"};
  options.rest_s = 0.01;
  LocalProcesses processes(options);
  const std::vector<Task> tasks = {{Task::Kind::simulate, 0}};
  const auto results = processes.run(JobFolder(folder.path()), tasks, {}, {});
  EXPECT_EQ(results[0].outcome, Outcome::environment_error);
  EXPECT_THAT(results[0].message, HasSubstr("/nonexistent/throng"));
}

}  // namespace
}  // namespace throng::jobs
