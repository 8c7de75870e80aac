#include "jobs/queue/store/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "base/error.h"
#include "tests/jobs/queue/store_fixture.h"

namespace throng::jobs {
namespace {

TEST_F(StoreTest, AddedAndChangedRowsSurviveReopening) {
  JobRow queued;
  JobRow running;
  {
    Store store(folder.path(), clock());
    running = store.add({"a", R"({"x":1})"}).row;
    now_ms = 2'000'000;
    queued = store.add({"b", "{}"}).row;
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

TEST_F(StoreTest, OthersOfTheMachineReadAndLockNothing) {
  const auto mode_of = [&](const char* name) {
    return static_cast<unsigned>(std::filesystem::status(folder.path() / name).permissions());
  };
  for (int i = 0; i < 2; ++i) {
    const Store store(folder.path(), clock());
    for (const char* name : {"jobs.sqlite", "jobs.sqlite-wal", "lock"}) {
      EXPECT_EQ(mode_of(name), 0600U) << name;
    }
    // As an earlier version has left them.
    for (const char* name : {"jobs.sqlite", "jobs.sqlite-wal", "lock"}) {
      std::filesystem::permissions(folder.path() / name, std::filesystem::perms(0644));
    }
  }
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
    ASSERT_EQ(store.list({}).size(), 1U);
    EXPECT_EQ(store.startable().at(0).name, "old");
    EXPECT_EQ(store.startable().at(0).kind, JobKind::dataset);
    EXPECT_EQ(store.list({.name_part = "old"}).size(), 1U);
  }
}

TEST_F(StoreTest, AStoreOfANewerProgramIsRefusedWithBothVersions) {
  { const Store store(folder.path(), clock()); }
  SQLite::Database(folder.path() / "jobs.sqlite", SQLite::OPEN_READWRITE)
      .exec("PRAGMA user_version = 1000");
  try {
    const Store store(folder.path(), clock());
    ADD_FAILURE() << "expected an error";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("version 1000; this program (throng "),
              std::string::npos)
        << error.what();
  }
}

TEST_F(StoreTest, CalibrationsAreListedApart) {
  Store store(folder.path(), clock());
  const JobRow dataset = store.add({"d", "{}"}).row;
  const JobRow calibration = store.add({"c", "{}", JobKind::calibration}).row;
  ASSERT_EQ(store.list({}).size(), 1U);
  EXPECT_EQ(store.list({})[0].id, dataset.id);
  ASSERT_EQ(store.list({.kind = JobKind::calibration}).size(), 1U);
  EXPECT_EQ(store.list({.kind = JobKind::calibration})[0].id, calibration.id);
  EXPECT_EQ(store.get(calibration.id)->kind, JobKind::calibration);
}

TEST_F(StoreTest, RunningJobsMayGoOnThenTheOldestQueuedOfEachOwner) {
  Store store(folder.path(), clock());
  EXPECT_TRUE(store.startable().empty());
  const JobRow first = store.add({"first", "{}"}).row;
  const JobRow second = store.add({"second", "{}"}).row;
  EXPECT_EQ(store.startable().at(0).id, first.id);
  const JobRow running = store.apply(second, JobEvent::start).value();
  EXPECT_EQ(store.startable().at(0).id, second.id);
  EXPECT_EQ(store.startable().size(), 2U);
  store.apply(running, JobEvent::succeed);
  EXPECT_EQ(store.startable().at(0).id, first.id);
  store.add({.name = "third"});
  const JobRow other = store.add({.name = "other", .owner = "them"}).row;
  const JobRow urgent = store.add({.name = "urgent", .priority = 3, .owner = "them"}).row;
  ASSERT_EQ(store.startable().size(), 2U);
  EXPECT_EQ(store.startable()[0].id, urgent.id);
  EXPECT_EQ(store.startable()[1].id, first.id);
}

TEST_F(StoreTest, AnEventCountsOnceAndForTheAttemptItWasMeantFor) {
  Store store(folder.path(), clock());
  const JobRow queued = store.add({"a", "{}"}).row;
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

TEST_F(StoreTest, TheHighestPriorityComesFirstAndCanBeChanged) {
  Store store(folder.path(), clock());
  const JobRow low = store.add({.name = "low", .priority = -1}).row;
  const JobRow usual = store.add({.name = "usual"}).row;
  const JobRow high = store.add({.name = "high", .priority = 5}).row;
  EXPECT_EQ(store.startable().at(0).id, high.id);
  EXPECT_EQ(store.change(low.id, {6, {"urgent"}})->priority, 6);
  EXPECT_EQ(store.startable().at(0).id, low.id);
  EXPECT_EQ(store.get(low.id)->labels, std::vector<std::string>{"urgent"});
  EXPECT_EQ(store.get(usual.id)->labels, std::vector<std::string>{});
  EXPECT_FALSE(store.change("jnosuchjob00000", {}));
}

TEST_F(StoreTest, ASubmissionSentTwiceIsOneJob) {
  Store store(folder.path(), clock());
  const Added first = store.add({.name = "a", .key = "k", .hash = "1"});
  const Added again = store.add({.name = "a", .key = "k", .hash = "1"});
  const Added other = store.add({.name = "b", .key = "k", .hash = "2"});
  EXPECT_TRUE(first.is_new);
  EXPECT_FALSE(again.is_new);
  EXPECT_TRUE(again.is_equal);
  EXPECT_EQ(again.row.id, first.row.id);
  EXPECT_FALSE(other.is_new);
  EXPECT_FALSE(other.is_equal);
  EXPECT_TRUE(store.add({.name = "c", .key = "l"}).is_new);
  EXPECT_TRUE(store.add({.name = "d"}).is_new);
  EXPECT_TRUE(store.add({.name = "d"}).is_new) << "no key, no repetition";
  EXPECT_EQ(store.list({}).size(), 4U);
}

TEST_F(StoreTest, TheTimeByWhichJobsAreKeptNeverJumps) {
  constexpr std::int64_t kDayMs = 86'400'000;
  std::int64_t steady_ms = 7;
  const Store::Clock steady = [&] { return steady_ms; };
  {
    Store store(folder.path(), clock(), steady);
    EXPECT_EQ(store.service_ms(), now_ms);
    now_ms += 100 * kDayMs;
    steady_ms += 5;
    EXPECT_EQ(store.service_ms(), 1'000'005);
    const JobRow row = store.add({.name = "a"}).row;
    const JobRow ended = store.apply(row, JobEvent::cancel).value();
    EXPECT_EQ(ended.kept_from_ms, 1'000'005);
    EXPECT_EQ(ended.ended_ms, now_ms);
    EXPECT_EQ(store.apply(ended, JobEvent::retry)->kept_from_ms, 0);
    store.save_service_clock();
  }
  steady_ms = 0;  // the machine was started again
  now_ms += 3000;
  {
    Store store(folder.path(), clock(), steady);
    EXPECT_EQ(store.service_ms(), 1'003'005);
    store.save_service_clock();
  }
  now_ms += 100 * kDayMs;  // set while the service was away
  {
    Store store(folder.path(), clock(), steady);
    EXPECT_EQ(store.service_ms(), 1'003'005 + kDayMs);
    store.save_service_clock();
  }
  now_ms -= 200 * kDayMs;
  EXPECT_EQ(Store(folder.path(), clock(), steady).service_ms(), 1'003'005 + kDayMs);
}

TEST_F(StoreTest, EventsAreRecordedWithTheirChange) {
  Store store(folder.path(), clock());
  const JobRow queued = store.add({.name = "a"}).row;
  const JobRow other = store.add({.name = "b"}).row;
  const JobRow running = store.apply(queued, JobEvent::start).value();
  EXPECT_FALSE(store.apply(queued, JobEvent::start)) << "too late: no event";
  store.record_event(running, "stage", R"({"stage":"rendering"})");
  const JobRow failed = store.apply(running, JobEvent::fail, "{}").value();
  store.record_event(running, "stage", "{}");  // of an attempt that is over
  const JobRow again = store.apply(failed, JobEvent::retry).value();
  EXPECT_EQ(again.state, JobState::queued);
  EXPECT_EQ(again.ended_ms, 0);
  EXPECT_EQ(again.error_json, "");
  std::vector<std::string> types;
  std::int64_t last = 0;
  for (const EventRow& event : store.events(queued.id, 0, 100)) {
    EXPECT_GT(event.seq, last);
    last = event.seq;
    EXPECT_EQ(event.job, queued.id);
    types.push_back(event.type);
  }
  EXPECT_EQ(types,
            (std::vector<std::string>{"submitted", "started", "stage", "failed", "retried"}));
  EXPECT_EQ(store.events("", 0, 100).size(), 6U);
  EXPECT_EQ(store.events("", 0, 2).back().job, other.id);
  EXPECT_EQ(store.last_event(), last);
  EXPECT_TRUE(store.events(queued.id, last, 100).empty());
  store.remove(queued.id);
  ASSERT_EQ(store.events(queued.id, 0, 100).size(), 1U);
  EXPECT_EQ(store.events(queued.id, 0, 100)[0].type, "removed");
}

TEST_F(StoreTest, DiskIsCountedAndBoundedPerOwner) {
  Store store(folder.path(), clock());
  const JobRow mine = store.add({.name = "a", .owner = "me"}).row;
  const JobRow theirs = store.add({.name = "b", .owner = "them"}).row;
  store.set_bytes(mine.id, 700);
  store.set_bytes(theirs.id, 5000);
  EXPECT_EQ(store.get(mine.id)->bytes, 700);
  EXPECT_EQ(store.total_bytes(), 5700);
  EXPECT_EQ(store.add({.name = "c", .owner = "me", .limits = {0, 701}}).over_quota, "");
  EXPECT_NE(store.add({.name = "d", .owner = "me", .limits = {0, 700}}).over_quota, "");
  EXPECT_NE(store.add({.name = "e", .owner = "me", .limits = {2, 0}}).over_quota, "");
  EXPECT_EQ(store.list({}).size(), 3U);
}

TEST_F(StoreTest, LimitsOfAnOwnerHoldForRetriesToo) {
  Store store(folder.path(), clock());
  const JobRow ended = store.add({.name = "a", .owner = "me"}).row;
  const JobRow cancelled = store.apply(ended, JobEvent::cancel).value();
  const JobRow active = store.add({.name = "b", .owner = "me"}).row;
  EXPECT_NE(store.retry(cancelled, {1, 0}).over_quota, "");
  EXPECT_EQ(store.get(ended.id)->state, JobState::cancelled);
  store.set_bytes(ended.id, 50);
  EXPECT_NE(store.retry(cancelled, {0, 50}).over_quota, "");
  const Retried retried = store.retry(cancelled, {2, 51});
  EXPECT_EQ(retried.over_quota, "");
  EXPECT_EQ(retried.row.value().state, JobState::queued);
  EXPECT_FALSE(store.retry(cancelled, {}).row) << "someone was faster";
  EXPECT_FALSE(store.retry(active, {}).row) << "it has not ended";
}

TEST_F(StoreTest, EndedJobsAreListedInTheOrderOfEndingExceptKeptOnes) {
  Store store(folder.path(), clock(), clock());
  const JobRow a = store.add({.name = "a"}).row;
  const JobRow b = store.add({.name = "b"}).row;
  const JobRow c = store.add({.name = "c"}).row;
  store.add({.name = "still waiting"});
  for (const JobRow& row : {c, a, b}) {
    ++now_ms;
    store.apply(row, JobEvent::cancel);
  }
  EXPECT_TRUE(store.change(b.id, {.keep = true})->keep);
  std::vector<std::string> names;
  for (const JobRow& row : store.ended(10)) names.push_back(row.name);
  EXPECT_EQ(names, (std::vector<std::string>{"c", "a"}));
  EXPECT_EQ(store.ended(1).size(), 1U);
}

TEST_F(StoreTest, EventsOfRemovedJobsAreForgottenInTheEnd) {
  Store store(folder.path(), clock());
  store.remove(store.add({.name = "a"}).row.id);
  store.add({.name = "b"});
  EXPECT_EQ(store.forget_events(0), 0);
  EXPECT_EQ(store.forget_events(store.now_ms() + 1), 1);
  ASSERT_EQ(store.events("", 0, 10).size(), 1U);
  EXPECT_EQ(store.events("", 0, 10)[0].type, "submitted");
}

TEST_F(StoreTest, RemovedJobsAreGone) {
  Store store(folder.path(), clock());
  const JobRow row = store.add({"a", "{}"}).row;
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

TEST_F(StoreTest, ADamagedRowHidesNoOther) {
  JobRow damaged;
  JobRow mislabeled;
  JobRow good;
  {
    Store store(folder.path(), clock());
    damaged = store.add({"a", "{}"}).row;
    mislabeled = store.add({.name = "b", .spec_json = "{}", .labels = {"x"}}).row;
    good = store.add({.name = "c", .spec_json = "{}", .labels = {"x"}}).row;
  }
  {
    SQLite::Database file(folder.path() / "jobs.sqlite", SQLite::OPEN_READWRITE);
    file.exec("PRAGMA ignore_check_constraints = ON");  // as a flipped bit
    file.exec("UPDATE job SET state = 'quexed', spec = x'ff00' WHERE id = '" + damaged.id + "'");
    file.exec("UPDATE job SET labels = '[\"x' WHERE id = '" + mislabeled.id + "'");
  }
  Store store(folder.path(), clock());
  EXPECT_EQ(store.list({}).size(), 3U);
  EXPECT_EQ(store.list({.label = "x"}).size(), 1U);
  EXPECT_EQ(store.count()[JobState::failed], 1);
  EXPECT_EQ(store.startable().at(0).id, mislabeled.id);
  const JobRow found = store.get(damaged.id).value();
  EXPECT_TRUE(found.is_damaged);
  EXPECT_EQ(found.state, JobState::failed);
  EXPECT_NE(found.error_json.find("damaged"), std::string::npos);
  EXPECT_TRUE(store.get(mislabeled.id)->labels.empty());
  EXPECT_FALSE(store.retry(found, {}).row);
  EXPECT_TRUE(store.remove(damaged.id));
  EXPECT_EQ(store.list({}).size(), 2U);
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
          const JobRow row = store.add({"n", "{}"}).row;
          EXPECT_TRUE(store.get(row.id));
          store.apply(row, JobEvent::start);
        }
      });
    }
  }
  std::set<std::string> ids;
  for (const JobRow& row : store.list({.limit = 1000})) {
    ids.insert(row.id);
    EXPECT_EQ(row.state, JobState::running);
  }
  EXPECT_EQ(ids.size(), static_cast<std::size_t>(kThreads * kJobs));
}

}  // namespace
}  // namespace throng::jobs
