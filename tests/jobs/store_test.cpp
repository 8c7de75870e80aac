#include "jobs/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "base/error.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

class StoreTest : public testing::Test {
 protected:
  Store::Clock clock() {
    return [this] { return now_ms; };
  }

  TemporaryFolder folder;
  std::int64_t now_ms = 1'000'000;
};

TEST_F(StoreTest, WhatWasAddedAndChangedSurvivesReopening) {
  JobRow queued;
  JobRow running;
  {
    Store store(folder.path(), clock());
    running = store.add("a", R"({"x":1})");
    now_ms = 2'000'000;
    queued = store.add("b", "{}");
    running = store.apply(running, JobEvent::start).value();
    store.save_progress(running, "[1]");
  }
  Store store(folder.path(), clock());
  const JobRow a = store.get(running.id).value();
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.spec_json, R"({"x":1})");
  EXPECT_EQ(a.state, JobState::running);
  EXPECT_EQ(a.attempt, 1);
  EXPECT_EQ(a.progress_json, "[1]");
  EXPECT_EQ(a.created_ms, 1'000'000);
  EXPECT_EQ(a.started_ms, 2'000'000);
  EXPECT_EQ(a.ended_ms, 0);
  EXPECT_EQ(store.get(queued.id)->state, JobState::queued);
  EXPECT_FALSE(store.get("jnosuchjob00000"));
}

// A data folder that an older service has left.
TEST_F(StoreTest, AStoreOfVersionOneIsTakenOver) {
  {
    SQLite::Database old(folder.path() / "jobs.sqlite",
                         SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    old.exec(
        "CREATE TABLE job (id TEXT PRIMARY KEY, name TEXT NOT NULL, state TEXT NOT NULL, attempt "
        "INTEGER NOT NULL DEFAULT 0, spec TEXT NOT NULL, progress TEXT NOT NULL DEFAULT '', error "
        "TEXT NOT NULL DEFAULT '', created_ms INTEGER NOT NULL, started_ms INTEGER NOT NULL "
        "DEFAULT 0, ended_ms INTEGER NOT NULL DEFAULT 0) WITHOUT ROWID");
    old.exec(
        "INSERT INTO job (id, name, state, spec, created_ms) VALUES ('j1', 'old', 'queued', '{}', "
        "5)");
    old.exec("PRAGMA user_version = 1");
  }
  for (int i = 0; i < 2; ++i) {  // and stays as it is from then on
    const Store store(folder.path(), clock());
    ASSERT_EQ(store.list(10).size(), 1U);
    EXPECT_EQ(store.next()->name, "old");
    EXPECT_EQ(store.next()->kind, JobKind::dataset);
  }
}

TEST_F(StoreTest, CalibrationsAreListedApart) {
  Store store(folder.path(), clock());
  const JobRow dataset = store.add("d", "{}");
  const JobRow calibration = store.add("c", "{}", JobKind::calibration);
  ASSERT_EQ(store.list(10).size(), 1U);
  EXPECT_EQ(store.list(10)[0].id, dataset.id);
  ASSERT_EQ(store.list(10, "", JobKind::calibration).size(), 1U);
  EXPECT_EQ(store.list(10, "", JobKind::calibration)[0].id, calibration.id);
  EXPECT_EQ(store.get(calibration.id)->kind, JobKind::calibration);
}

TEST_F(StoreTest, TheRunningJobComesNextThenTheOldestQueued) {
  Store store(folder.path(), clock());
  EXPECT_FALSE(store.next());
  const JobRow first = store.add("first", "{}");
  const JobRow second = store.add("second", "{}");
  EXPECT_EQ(store.next()->id, first.id);
  const JobRow running = store.apply(second, JobEvent::start).value();
  EXPECT_EQ(store.next()->id, second.id);
  store.apply(running, JobEvent::succeed);
  EXPECT_EQ(store.next()->id, first.id);
}

TEST_F(StoreTest, AnEventCountsOnceAndForTheAttemptItWasMeantFor) {
  Store store(folder.path(), clock());
  const JobRow queued = store.add("a", "{}");
  const JobRow first = store.apply(queued, JobEvent::start).value();
  EXPECT_FALSE(store.apply(queued, JobEvent::start)) << "someone else took it already";
  EXPECT_FALSE(store.apply(queued, JobEvent::succeed)) << "not in this state";
  const JobRow second = store.apply(first, JobEvent::resume).value();
  EXPECT_EQ(second.attempt, 2);
  EXPECT_FALSE(store.apply(first, JobEvent::succeed)) << "an earlier attempt came back";
  store.save_progress(first, "late");
  EXPECT_EQ(store.get(first.id)->progress_json, "");
  now_ms = 3'000'000;
  EXPECT_TRUE(store.apply(second, JobEvent::fail, R"({"message":"m"})"));
  const JobRow failed = store.get(first.id).value();
  EXPECT_EQ(failed.state, JobState::failed);
  EXPECT_EQ(failed.error_json, R"({"message":"m"})");
  EXPECT_EQ(failed.ended_ms, 3'000'000);
  EXPECT_FALSE(store.apply(failed, JobEvent::cancel));
}

TEST_F(StoreTest, PagesListEveryJobOnceNewestFirst) {
  Store store(folder.path(), clock());
  std::vector<std::string> added(25);
  for (std::string& id : added) id = store.add("n", "{}").id;
  std::vector<std::string> listed;
  std::string after;
  for (std::vector<JobRow> page; !(page = store.list(10, after)).empty(); after = page.back().id) {
    for (const JobRow& row : page) listed.push_back(row.id);
  }
  std::reverse(added.begin(), added.end());
  EXPECT_EQ(listed, added);
}

TEST_F(StoreTest, RemovedJobsAreGone) {
  Store store(folder.path(), clock());
  const JobRow row = store.add("a", "{}");
  EXPECT_TRUE(store.remove(row.id));
  EXPECT_FALSE(store.remove(row.id));
  EXPECT_FALSE(store.get(row.id));
  EXPECT_FALSE(store.apply(row, JobEvent::start));
}

TEST_F(StoreTest, OneServerPerFolder) {
  const Store store(folder.path());
  EXPECT_THROW(Store second(folder.path()), EnvironmentError);
}

TEST_F(StoreTest, ADamagedFileIsReportedNotReplaced) {
  write_file_atomically(folder.path() / "jobs.sqlite", std::string(4096, 'x'));
  EXPECT_THROW(Store store(folder.path()), EnvironmentError);
  EXPECT_EQ(read_file(folder.path() / "jobs.sqlite"), std::string(4096, 'x'));
}

TEST_F(StoreTest, ThreadsAddAndReadAtOnce) {
  Store store(folder.path());
  constexpr int kThreads = 4;
  constexpr int kJobs = 10;
  {
    std::vector<std::jthread> threads(kThreads);
    for (std::jthread& thread : threads) {
      thread = std::jthread([&] {
        for (int i = 0; i < kJobs; ++i) {
          const JobRow row = store.add("n", "{}");
          EXPECT_TRUE(store.get(row.id));
          store.apply(row, JobEvent::start);
        }
      });
    }
  }
  std::set<std::string> ids;
  for (const JobRow& row : store.list(1000)) {
    ids.insert(row.id);
    EXPECT_EQ(row.state, JobState::running);
  }
  EXPECT_EQ(ids.size(), static_cast<std::size_t>(kThreads * kJobs));
}

}  // namespace
}  // namespace throng::jobs
