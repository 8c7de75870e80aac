// Jobs that are active at once: shares of owners, priorities, limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <thread>

#include "server/api/service.h"
#include "tests/server/service_fixture.h"

namespace throng::server {
namespace {

using jobs::JobRow;
using jobs::JobState;
using jobs::Task;
using jobs::TaskResult;

/// Jobs whose tasks wait until they are released.
class SeveralJobs : public ServiceFixture {
 protected:
  SeveralJobs() {
    executor.before_in = [this](const jobs::JobFolder& folder, const Task&) {
      const std::string id = folder.path().filename();
      while (true) {
        {
          const std::lock_guard lock(mutex);
          at_work.insert(id);
          if (all_released || free.contains(id)) return TaskResult{};
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    };
  }
  ~SeveralJobs() override { release_all(); }

  ServiceOptions with_active(int max_active) const {
    ServiceOptions several = options();
    several.max_active_jobs = max_active;
    return several;
  }
  void release(const std::string& id) {
    const std::lock_guard lock(mutex);
    free.insert(id);
  }
  void release_all() {
    const std::lock_guard lock(mutex);
    all_released = true;
  }
  bool is_at_work(const std::string& id) {
    return wait_until([&] {
      const std::lock_guard lock(mutex);
      return at_work.contains(id);
    });
  }

  std::mutex mutex;
  std::set<std::string> free;
  std::set<std::string> at_work;
  bool all_released = false;
};

TEST_F(SeveralJobs, AShortOneEndsWhileALongOneRuns) {
  Service service(with_active(4), executor);
  const std::string large = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(is_at_work(large));
  const std::string small = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(is_at_work(small));
  release(small);
  ASSERT_TRUE(reaches(service, small, JobState::succeeded));
  EXPECT_EQ(service.queue().get(large)->state, JobState::running);
  release(large);
  EXPECT_TRUE(reaches(service, large, JobState::succeeded));
}

TEST_F(SeveralJobs, BeyondTheLimitEachOwnerHasOneAndHigherPrioritiesBegin) {
  Service service(with_active(1), executor);
  const auto submit = [&](const std::string& owner, int priority = 0) {
    return service.queue()
        .submit({.job = job_document(), .priority = priority, .owner = owner})
        .row.id;
  };
  const std::string first = submit("a");
  ASSERT_TRUE(is_at_work(first));
  const std::string second = submit("a");
  const std::string others = submit("b");
  EXPECT_TRUE(is_at_work(others));
  const std::string urgent = submit("a", 5);
  EXPECT_TRUE(is_at_work(urgent));
  const std::string as_urgent = submit("a", 5);
  const std::string last = submit("c");
  EXPECT_TRUE(is_at_work(last)) << "all that wait were looked at";
  EXPECT_EQ(service.queue().get(second)->state, JobState::queued);
  EXPECT_EQ(service.queue().get(as_urgent)->state, JobState::queued);
  // Raised above all others, it begins.
  service.queue().change(second, {.priority = 9});
  EXPECT_TRUE(is_at_work(second));
  release_all();
  for (const std::string& id : {first, second, others, urgent, as_urgent, last}) {
    EXPECT_TRUE(reaches(service, id, JobState::succeeded));
  }
}

TEST_F(SeveralJobs, CancellingOneLeavesTheOthers) {
  Service service(with_active(3), executor);
  std::vector<std::string> ids;
  for (int i = 0; i < 3; ++i) ids.push_back(service.queue().submit({job_document()}).row.id);
  for (const std::string& id : ids) ASSERT_TRUE(is_at_work(id));
  const std::string waiting = service.queue().submit({job_document()}).row.id;
  std::jthread canceller([&] { service.queue().cancel(ids[1]); });
  ASSERT_TRUE(reaches(service, ids[1], JobState::cancelled));
  release(ids[1]);  // its task ends, and makes room
  EXPECT_TRUE(is_at_work(waiting));
  release_all();
  for (const std::string& id : {ids[0], ids[2], waiting}) {
    EXPECT_TRUE(reaches(service, id, JobState::succeeded));
  }
  EXPECT_EQ(service.queue().get(ids[1])->state, JobState::cancelled);
}

TEST_F(SeveralJobs, AllGoOnAfterAFullDiskAndAfterARestart) {
  std::atomic<std::int64_t> free_bytes = 1000;
  std::vector<std::string> ids;
  {
    ServiceOptions limited = with_active(3);
    limited.housekeeping.disk = [&] { return DiskState{free_bytes.load()}; };
    limited.housekeeping.min_free_bytes = 100;
    Service service(limited, executor);
    for (int i = 0; i < 3; ++i) ids.push_back(service.queue().submit({job_document()}).row.id);
    for (const std::string& id : ids) ASSERT_TRUE(is_at_work(id));
    free_bytes = 50;
    ASSERT_TRUE(wait_until([&] { return !service.queue().paused().empty(); }));
    for (const std::string& id : ids) ASSERT_EQ(service.queue().get(id)->bytes, 0);
    release(ids[0]);
    release(ids[1]);
    release(ids[2]);
    for (const std::string& id : ids) {
      // Its files are counted when it has stopped.
      ASSERT_TRUE(wait_until([&] { return service.queue().get(id)->bytes > 0; }));
      EXPECT_EQ(service.queue().get(id)->state, JobState::running);
      EXPECT_NE(service.queue().get(id)->waiting_for, "");
    }
  }
  jobs::FakeExecutor second;
  Service service(with_active(2), second);
  for (const std::string& id : ids) EXPECT_TRUE(reaches(service, id, JobState::succeeded));
}

TEST_F(SeveralJobs, ACancelledJobsFilesCount) {
  Service service(with_active(2), executor);
  const std::string id = service.queue().submit({.job = job_document(), .owner = "me"}).row.id;
  ASSERT_TRUE(is_at_work(id));
  write_file_atomically(service.folders().job_folder(id) / "work/large", std::string(1 << 20, 'x'));
  std::jthread canceller([&] { service.queue().cancel(id); });
  ASSERT_TRUE(reaches(service, id, JobState::cancelled));
  release(id);
  canceller.join();
  EXPECT_GE(service.queue().get(id)->bytes, 1 << 20);
  EXPECT_THROW(service.queue().submit({.job = job_document(), .owner = "me", .max_bytes = 1 << 20}),
               QuotaError);
}

}  // namespace
}  // namespace throng::server
