#include "jobs/queue/workers/admission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "tests/base/virtual_clock.h"

namespace throng::jobs {
namespace {

using namespace std::chrono_literals;

/// A job with tasks of equal length, which takes one step at a time.
struct TestJob {
  TestJob(Admission& admission, std::string owner_name, std::string id, std::size_t tasks,
          int rank = 0, std::int64_t memory = 0)
      : name(std::move(id)),
        left(tasks),
        priority(rank),
        memory_mib(memory),
        claimant(admission, owner_name, name) {}

  bool try_to_begin() {
    if (left == 0) {
      claimant.withdraw();
      return false;
    }
    auto permit = claimant.request(priority, left + running.size(), memory_mib);
    if (!permit) return false;
    running.push_back(std::move(*permit));
    --left;
    return true;
  }

  std::string name;
  std::size_t left;
  int priority;
  std::int64_t memory_mib;
  Admission::Claimant claimant;
  std::vector<Admission::Permit> running;
};

/// Lets all jobs begin what they may, each as threads do: it asks until it is refused.
void let_begin(const std::vector<TestJob*>& jobs) {
  for (int round = 0; round < 10; ++round) {
    for (TestJob* job : jobs) {
      while (job->try_to_begin()) {
      }
    }
  }
}

/// One worker takes one task: all have asked before it is free. The name of the task's job.
std::string next_job(const std::vector<TestJob*>& jobs) {
  std::vector<Admission::Permit> ended;
  for (TestJob* job : jobs) {
    for (Admission::Permit& permit : job->running) ended.push_back(std::move(permit));
    job->running.clear();
  }
  for (TestJob* job : jobs) job->try_to_begin();
  ended.clear();
  let_begin(jobs);
  std::string name;
  for (const TestJob* job : jobs) {
    if (!job->running.empty()) name += job->name;
  }
  return name;
}

/// The order in which one worker takes the tasks of all.
std::vector<std::string> admission_order(const std::vector<TestJob*>& jobs, std::size_t steps) {
  std::vector<std::string> order;
  for (std::size_t i = 0; i < steps; ++i) order.push_back(next_job(jobs));
  return order;
}

std::size_t count(const std::vector<std::string>& order, const std::string& name) {
  return static_cast<std::size_t>(std::count(order.begin(), order.end(), name));
}

TEST(Admission, NoMoreTasksThanWorkers) {
  Admission admission({.workers = 2});
  TestJob job(admission, "a", "j1", 5);
  EXPECT_TRUE(job.try_to_begin());
  EXPECT_TRUE(job.try_to_begin());
  EXPECT_FALSE(job.try_to_begin());
  job.running.pop_back();
  EXPECT_TRUE(job.try_to_begin());
}

TEST(Admission, AHigherPriorityGetsTheNextFreeWorker) {
  Admission admission({.workers = 1});
  TestJob low(admission, "a", "j1", 100);
  TestJob high(admission, "a", "j2", 3, 100);
  EXPECT_TRUE(low.try_to_begin());
  EXPECT_FALSE(high.try_to_begin()) << "a task that runs is not ended";
  low.running.clear();
  EXPECT_FALSE(low.try_to_begin());
  EXPECT_TRUE(high.try_to_begin());
}

TEST(Admission, OwnersGetEqualPartsOfTheWorkers) {
  Admission admission({.workers = 4});
  TestJob a1(admission, "a", "j1", 100);
  TestJob a2(admission, "a", "j2", 100);
  TestJob b(admission, "b", "j3", 100);
  const std::vector<TestJob*> jobs = {&a1, &a2, &b};
  TestJob before(admission, "z", "j0", 4);
  let_begin({&before});
  let_begin(jobs);  // all wait
  before.running.clear();
  before.claimant.withdraw();
  let_begin(jobs);
  EXPECT_EQ(a1.running.size() + a2.running.size(), 2U);
  EXPECT_EQ(b.running.size(), 2U);
}

TEST(Admission, OwnersTakeTurnsAtOneWorkerByTheTimeTheyHad) {
  VirtualClock clock;
  Admission admission({.workers = 1, .now = clock.now()});
  TestJob slow(admission, "a", "j1", 100);
  TestJob quick(admission, "b", "j2", 100);
  std::map<std::string, int> tasks;
  for (int i = 0; i < 40; ++i) {
    const std::string next = next_job({&slow, &quick});
    ++tasks[next];
    clock.advance(next == "j1" ? 40s : 10s);
  }
  EXPECT_EQ(tasks["j1"], 8);
  EXPECT_EQ(tasks["j2"], 32);
}

TEST(Admission, AReturningOwnerGetsNothingForTheTimeAway) {
  VirtualClock clock;
  Admission admission({.workers = 1, .now = clock.now()});
  TestJob old(admission, "a", "j1", 1000);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(old.try_to_begin());
    clock.advance(5s);
    old.running.clear();
  }
  TestJob fresh(admission, "b", "j2", 1000);
  std::map<std::string, int> tasks;
  for (int i = 0; i < 20; ++i) {
    ++tasks[next_job({&old, &fresh})];
    clock.advance(2s);
  }
  EXPECT_EQ(tasks["j1"], 10);
  EXPECT_EQ(tasks["j2"], 10);
}

TEST(Admission, SmallJobsOfAnOwnerEndEarlyAndTheOldestIsNotForgotten) {
  Admission admission({.workers = 1});
  TestJob large(admission, "a", "j1", 200);
  TestJob small(admission, "a", "j2", 6);
  EXPECT_EQ(next_job({&large}), "j1");
  const auto order = admission_order({&large, &small}, 9);
  EXPECT_EQ(count(order, "j2"), 6U) << "six of the first nine";
  EXPECT_GE(count(order, "j1"), 2U) << "every fourth is the oldest job's";
}

TEST(Admission, TasksWaitForMemory) {
  Admission admission({.workers = 4, .memory_mib = 1000});
  TestJob job(admission, "a", "j1", 4, 0, 400);
  EXPECT_TRUE(job.try_to_begin());
  EXPECT_FALSE(job.claimant.waits_for_memory());
  EXPECT_TRUE(job.try_to_begin());
  EXPECT_FALSE(job.try_to_begin());
  EXPECT_TRUE(job.claimant.waits_for_memory());
  TestJob small(admission, "a", "j2", 9, -5, 150);
  EXPECT_TRUE(small.try_to_begin()) << "smaller tasks may go ahead for a while";
  EXPECT_FALSE(small.try_to_begin());
  job.running.pop_back();
  EXPECT_TRUE(job.try_to_begin());
}

TEST(Admission, ATaskThatNeedsMoreThanThereIsRunsAlone) {
  Admission admission({.workers = 4, .memory_mib = 1000});
  TestJob huge(admission, "a", "j1", 1, 0, 5000);
  EXPECT_TRUE(huge.try_to_begin());
  TestJob small(admission, "a", "j2", 1, 0, 10);
  EXPECT_FALSE(small.try_to_begin());
}

TEST(Admission, TasksWaitWhileTheMachineHasNoMemory) {
  std::int64_t available = 100;
  Admission admission({.workers = 4, .memory_mib = 0, .available_mib = [&] { return available; }});
  TestJob job(admission, "a", "j1", 4, 0, 400);
  EXPECT_FALSE(job.try_to_begin());
  EXPECT_TRUE(job.claimant.waits_for_memory());
  available = 10'000;
  EXPECT_TRUE(job.try_to_begin());
}

TEST(Admission, MemoryThatABegunTaskHasNotTakenYetIsPromised) {
  VirtualClock clock;
  Admission admission(
      {.workers = 4, .memory_mib = 0, .available_mib = [] { return 1500; }, .now = clock.now()});
  TestJob job(admission, "a", "j1", 4, 0, 700);
  EXPECT_TRUE(job.try_to_begin());
  clock.advance(10s - 1ms);
  EXPECT_FALSE(job.try_to_begin());
  clock.advance(1ms);
  EXPECT_TRUE(job.try_to_begin()) << "what it has taken is no longer available";
  EXPECT_FALSE(job.try_to_begin());
  job.running.clear();
  EXPECT_TRUE(job.try_to_begin());
}

TEST(Admission, SmallerTasksGoAheadOfOneThatWaitsForMemoryForAMinute) {
  VirtualClock clock;
  Admission admission({.workers = 4, .memory_mib = 1000, .now = clock.now()});
  TestJob large(admission, "a", "j1", 2, 0, 700);
  EXPECT_TRUE(large.try_to_begin());
  EXPECT_FALSE(large.try_to_begin());
  TestJob small(admission, "a", "j2", 9, -5, 100);
  clock.advance(60s - 1ms);
  EXPECT_FALSE(large.try_to_begin());
  EXPECT_TRUE(small.try_to_begin());
  clock.advance(1ms);
  EXPECT_FALSE(large.try_to_begin());
  EXPECT_FALSE(small.try_to_begin());
}

TEST(Admission, AJobThatIsAheadButDoesNotAskHoldsBackNobody) {
  VirtualClock clock;
  Admission admission({.workers = 1, .now = clock.now()});
  TestJob busy(admission, "a", "j1", 10, 50);
  TestJob other(admission, "a", "j2", 10);
  EXPECT_TRUE(other.try_to_begin());
  EXPECT_FALSE(busy.try_to_begin());
  other.running.clear();
  clock.advance(1s);
  EXPECT_FALSE(other.try_to_begin()) << "the other has asked within a second";
  clock.advance(1ms);
  EXPECT_TRUE(other.try_to_begin());
}

TEST(Admission, DrainsUntilNoTaskRuns) {
  Admission admission({.workers = 2});
  TestJob job(admission, "a", "j1", 3);
  ASSERT_TRUE(job.try_to_begin());
  admission.drain(0ms, {});  // one runs when the limit has passed
  EXPECT_FALSE(job.try_to_begin());
  job.running.clear();
  admission.drain(24h, {});  // returns at once
  EXPECT_FALSE(job.try_to_begin()) << "none is begun afterwards";
}

}  // namespace
}  // namespace throng::jobs
