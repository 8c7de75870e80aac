#include "server/backup/backup.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <map>

#include "base/error.h"
#include "base/files/hash.h"
#include "server/access/keys.h"
#include "tests/server/service_fixture.h"

namespace throng::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const OnBackupBytes kQuiet = [](std::int64_t, std::int64_t) {};

std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
  }
  return files;
}

/// The message of what `work` throws; "" if it throws nothing.
template <typename Error, typename Work>
std::string thrown_message(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class BackupTest : public ServiceFixture {
 protected:
  BackupTest() { fs::create_directories(work.path()); }

  std::string finished_job(Service& service) const {
    const std::string id = service.queue().submit({.job = job_document()}).row.id;
    EXPECT_TRUE(reaches(service, id, jobs::JobState::succeeded));
    return id;
  }

  /// Writes the backup's list and note again, as an attacker does after changing its files.
  void sign(const std::string& sums) const {
    write_file_atomically(out / "SHA256SUMS", sums);
    nlohmann::json note = nlohmann::json::parse(read_file(out / "backup.json"));
    note["sums_sha256"] = sha256_hex(sums);
    write_file_atomically(out / "backup.json", note.dump());
  }

  std::string refusal() const {
    return thrown_message<InputError>([&] { restore(out, again, "", kQuiet, {}); });
  }

  jobs::TemporaryFolder work;
  fs::path out = work.path() / "backup";
  fs::path again = work.path() / "again";
};

TEST_F(BackupTest, ARestoredServiceHasTheSameJobsAndBytes) {
  std::string id;
  std::map<std::string, std::string> before;
  {
    Service service(options(), executor);
    Keys(data.path()).create("me", Scope::admin);
    id = finished_job(service);
    before = files_below(service.folders().job_folder(id) / "dataset");
    // A link that a worker could have made is not followed.
    fs::create_symlink(data.path() / "keys.sqlite", service.folders().job_folder(id) / "work/link");
    back_up({.data = data.path(), .output = out}, kQuiet, {});
  }
  EXPECT_FALSE(fs::exists(out / "data/jobs" / id / "work/link"));
  restore(out, again, "", kQuiet, {});
  ServiceOptions other = options();
  other.data = again;
  const Service service(other, executor);
  ASSERT_EQ(service.queue().list({}).size(), 1U);
  EXPECT_EQ(service.queue().get(id)->state, jobs::JobState::succeeded);
  EXPECT_EQ(files_below(service.folders().job_folder(id) / "dataset"), before);
  EXPECT_EQ(Keys(again).list().at(0).name, "me");
  for (const fs::path& folder : {out, again}) {
    EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all) << folder;
  }
}

TEST_F(BackupTest, QueuesOrLeavesOutJobsThatChangeMeanwhile) {
  Service service(options(), executor);
  const std::string kept = finished_job(service);
  const std::string removed = finished_job(service);
  const std::string retried = finished_job(service);
  SQLite::Database live(data.path() / "jobs.sqlite", SQLite::OPEN_READWRITE);
  bool is_changed = false;
  const OnBackupBytes change = [&](std::int64_t, std::int64_t) {
    if (std::exchange(is_changed, true)) return;
    service.housekeeping().remove(removed);
    live.exec(fmt::format("UPDATE job SET attempt = attempt + 1 WHERE id = '{}'", retried));
  };
  back_up({.data = data.path(), .output = out}, change, {});
  restore(out, again, "", kQuiet, {});
  EXPECT_TRUE(fs::exists(again / "jobs" / kept / "dataset/manifest.json"));
  EXPECT_FALSE(fs::exists(again / "jobs" / removed));
  EXPECT_FALSE(fs::exists(again / "jobs" / retried / "dataset"));
  EXPECT_TRUE(fs::exists(again / "jobs" / retried / "work"));
  ServiceOptions other = options();
  other.data = again;
  Service restored(other, executor);
  EXPECT_EQ(restored.queue().list({}).size(), 2U);
  EXPECT_TRUE(reaches(restored, retried, jobs::JobState::succeeded));
}

TEST_F(BackupTest, CanLeaveOutTheJobsThatHaveEnded) {
  Service service(options(), executor);
  finished_job(service);
  Gate gate(executor);
  const std::string running = service.queue().submit({.job = job_document()}).row.id;
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  back_up({.data = data.path(), .output = out, .with_datasets = false}, kQuiet, {});
  gate.open();
  restore(out, again, "", kQuiet, {});
  ServiceOptions other = options();
  other.data = again;
  Service restored(other, executor);
  ASSERT_EQ(restored.queue().list({}).size(), 1U);
  EXPECT_TRUE(reaches(restored, running, jobs::JobState::succeeded)) << "it runs again";
}

TEST_F(BackupTest, LeavesNothingWhenItIsCancelledOrTheFoldersAreWrong) {
  Service service(options(), executor);
  finished_job(service);
  const auto refused = [&](const fs::path& from, const fs::path& to) {
    return thrown_message<InputError>([&] { back_up({.data = from, .output = to}, kQuiet, {}); });
  };
  EXPECT_THAT(refused(work.path(), out), HasSubstr("expected the data folder of a service"));
  EXPECT_THAT(refused(data.path(), data.path() / "b"), HasSubstr("neither in"));
  EXPECT_THAT(refused(data.path(), data.path().parent_path()), HasSubstr("neither in"));
  fs::create_directory(out);
  EXPECT_THAT(refused(data.path(), out), HasSubstr("which is there already"));
  fs::remove(out);
  std::stop_source stop;
  const OnBackupBytes cancel = [&](std::int64_t, std::int64_t) { stop.request_stop(); };
  EXPECT_THROW(back_up({.data = data.path(), .output = out}, cancel, stop.get_token()), Cancelled);
  EXPECT_TRUE(fs::is_empty(work.path()));
  back_up({.data = data.path(), .output = out}, kQuiet, {});
  EXPECT_THROW(restore(out, again, "", cancel, stop.get_token()), Cancelled);
  EXPECT_FALSE(fs::exists(again));
}

TEST_F(BackupTest, RefusesDamagedAndHostileBackupsBeforeItWrites) {
  {
    Service service(options(), executor);
    finished_job(service);
    write_file_atomically(data.path() / "audit.log", "line\n");
    back_up({.data = data.path(), .output = out}, kQuiet, {});
  }
  fs::create_directory(again);
  write_file_atomically(again / "mine", "x");
  EXPECT_THAT(refusal(), HasSubstr("which is not empty"));
  fs::remove(again / "mine");

  const fs::path log = out / "data/audit.log";
  write_file_atomically(log, "another");
  EXPECT_THAT(refusal(), HasSubstr("audit.log: found other bytes"));
  fs::remove(log);
  EXPECT_THAT(refusal(), HasSubstr("audit.log: found no such file"));
  write_file_atomically(work.path() / "secret", "line\n");
  fs::create_symlink(work.path() / "secret", log);
  EXPECT_THAT(refusal(), HasSubstr("audit.log: found no such file, or a link"));
  fs::remove(log);
  write_file_atomically(log, "line\n");

  const std::string sums = read_file(out / "SHA256SUMS");
  write_file_atomically(out / "SHA256SUMS", sums + "\n");
  EXPECT_THAT(refusal(), HasSubstr("SHA256SUMS: found another file than was written"));
  const std::string hash = sha256_hex("line\n");
  for (const char* path :
       {"data/../../x", "data//x", "data/jobs/a\\b", "data/scenarios/x", "data/lock", "data/jobs",
        "data/audit.log/x", "elsewhere/x", "data/audit.log"}) {
    sign(sums + hash + "  " + path + "\n");
    EXPECT_THAT(refusal(), HasSubstr("SHA256SUMS: line ")) << path;
  }
  sign("");
  EXPECT_THAT(refusal(), HasSubstr("no data/jobs.sqlite"));

  SQLite::Database(out / "data/jobs.sqlite", SQLite::OPEN_READWRITE)
      .exec("UPDATE job SET id = '../../../home'");
  std::string changed = sums;
  const std::size_t line = changed.rfind('\n', changed.find("data/jobs.sqlite")) + 1;
  changed.replace(line, hash.size(), sha256_hex_of_file(out / "data/jobs.sqlite"));
  sign(changed);
  EXPECT_THAT(refusal(), HasSubstr("a job with the id ../../../home"));

  nlohmann::json note = nlohmann::json::parse(read_file(out / "backup.json"));
  note["format"] = "throng backup 9";
  write_file_atomically(out / "backup.json", note.dump());
  EXPECT_THAT(refusal(), HasSubstr("/format: found \"throng backup 9\", by throng "));
  fs::remove(out / "backup.json");
  EXPECT_THAT(refusal(), HasSubstr("expected the folder of a complete backup"));
  EXPECT_TRUE(fs::is_empty(again));
}

}  // namespace
}  // namespace throng::server
