#include "server/api/service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/resource_exhaustion.h"
#include "server/jobs/disk_watch.h"
#include "tests/server/service_fixture.h"

namespace throng::server {
namespace {

using jobs::JobRow;
using jobs::JobState;
using jobs::Outcome;
using jobs::Task;
using jobs::TaskResult;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class ServiceTest : public ServiceFixture {
 protected:
  /// Options of a service on a disk that has `free` bytes, of which 100 have to stay free.
  /// Rendering fills it: tasks fail then as those of workers that cannot write.
  ServiceOptions on_small_disk(std::atomic<std::int64_t>& free) {
    ServiceOptions limited = options();
    limited.housekeeping.disk = [&] {
      ++looks;
      return DiskState{free.load()};
    };
    limited.housekeeping.min_free_bytes = 100;
    executor.before = [&](const Task& task) {
      if (task.kind == Task::Kind::render) free = 50;
      return free < 100 ? TaskResult{Outcome::environment_error, 3, "no space left", {}}
                        : TaskResult{};
    };
    return limited;
  }

  std::atomic<int> looks = 0;  ///< at that disk
};

TEST_F(ServiceTest, AJobRunsToItsDataset) {
  Service service(options(), executor);
  const JobRow row = service.queue().submit({job_document()}).row;
  EXPECT_EQ(row.name, "yard");
  ASSERT_TRUE(reaches(service, row.id, JobState::succeeded));
  EXPECT_TRUE(std::filesystem::exists(service.folders().dataset_folder(row.id) / "manifest.json"));
  const json progress = json::parse(service.queue().get(row.id)->progress_json);
  EXPECT_EQ(progress["stage"], "finished");
  EXPECT_EQ(progress["frames_done"], 3);
  EXPECT_EQ(progress["runs"].size(), 1U);
}

TEST_F(ServiceTest, JobsRunInTheOrderTheyCame) {
  Gate gate(executor);
  Service service(options(), executor);
  const JobRow first = service.queue().submit({job_document()}).row;
  const JobRow second = service.queue().submit({job_document()}).row;
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  EXPECT_EQ(service.queue().get(first.id)->state, JobState::running);
  EXPECT_EQ(service.queue().get(second.id)->state, JobState::queued);
  gate.open();
  EXPECT_TRUE(reaches(service, second.id, JobState::succeeded));
  EXPECT_EQ(service.queue().get(first.id)->state, JobState::succeeded);
}

TEST_F(ServiceTest, AFailureIsToldWithoutPathsAndTheNextJobRuns) {
  std::atomic<bool> fails = true;
  const std::string place = data.path().string();
  executor.before = [&](const Task&) {
    return fails.exchange(false) ? TaskResult{Outcome::crashed, 3, "died in " + place + "/x", {}}
                                 : TaskResult{};
  };
  Service service(options(), executor);
  const JobRow bad = service.queue().submit({job_document()}).row;
  const JobRow good = service.queue().submit({job_document()}).row;
  ASSERT_TRUE(reaches(service, good.id, JobState::succeeded));
  const JobRow failed = service.queue().get(bad.id).value();
  EXPECT_EQ(failed.state, JobState::failed);
  EXPECT_THAT(failed.error_json, HasSubstr("run000/trace: died in x"));
  EXPECT_THAT(failed.error_json, Not(HasSubstr(place)));
}

TEST_F(ServiceTest, AnInputErrorOfAWorkerKeepsItsPointers) {
  executor.before = [](const Task&) {
    return TaskResult{Outcome::input_error, 1, "m", {{"", "/crowd/agents", "9", "at most 2"}}};
  };
  Service service(options(), executor);
  const JobRow row = service.queue().submit({job_document()}).row;
  ASSERT_TRUE(reaches(service, row.id, JobState::failed));
  const json error = json::parse(service.queue().get(row.id)->error_json);
  EXPECT_EQ(error["kind"], "input");
  EXPECT_EQ(error["problems"][0]["pointer"], "/crowd/agents");
}

TEST_F(ServiceTest, NoPartOfAMistakeSaysWhereTheDataLie) {
  const std::string place = data.path().string();
  executor.before = [&](const Task&) {
    const std::string file = place + "/jobs/x/file";
    return TaskResult{Outcome::input_error, 1, "m", {{file, file, file, file}}};
  };
  Service service(options(), executor);
  const JobRow row = service.queue().submit({job_document()}).row;
  ASSERT_TRUE(reaches(service, row.id, JobState::failed));
  EXPECT_THAT(service.queue().get(row.id)->error_json, Not(HasSubstr(place)));
}

TEST_F(ServiceTest, RunningAndQueuedJobsGoOnAfterARestart) {
  std::string running;
  std::string queued;
  {
    Gate gate(executor);
    std::optional<Service> service(std::in_place, options(), executor);
    running = service->queue().submit({job_document()}).row.id;
    queued = service->queue().submit({job_document()}).row.id;
    ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
    const std::jthread ender([&] { service.reset(); });
    // The task ends only after the service has begun to.
    EXPECT_TRUE(wait_until([&] { return executor.was_stopped(); }));
    gate.open();
  }
  const std::size_t done_before = executor.done().size();
  EXPECT_LT(done_before, 4U) << "the first service ended in the middle";
  jobs::FakeExecutor second;
  Service service(options(), second);
  ASSERT_TRUE(reaches(service, queued, JobState::succeeded));
  EXPECT_EQ(service.queue().get(running)->state, JobState::succeeded);
  EXPECT_EQ(service.queue().get(running)->attempt, 2);
  EXPECT_EQ(service.queue().get(queued)->attempt, 1);
  // Published tasks were not repeated: 4 tasks per job in all.
  EXPECT_EQ(done_before + second.done().size(), 8U);
}

TEST_F(ServiceTest, RemovingARunningJobEndsItAndItsFiles) {
  Gate gate(executor);
  Service service(options(), executor);
  const JobRow row = service.queue().submit({job_document()}).row;
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  {
    // Its task ends only after it was asked to.
    const std::jthread opener([&] {
      EXPECT_TRUE(wait_until([&] { return executor.was_stopped(); }));
      gate.open();
    });
    EXPECT_TRUE(service.housekeeping().remove(row.id));
  }
  EXPECT_FALSE(service.queue().get(row.id));
  EXPECT_FALSE(std::filesystem::exists(data.path() / "jobs" / row.id));
  EXPECT_FALSE(std::filesystem::exists(data.path() / "trash" / row.id));
  EXPECT_FALSE(service.housekeeping().remove(row.id));
  const JobRow next = service.queue().submit({job_document()}).row;
  EXPECT_TRUE(reaches(service, next.id, JobState::succeeded));
}

TEST_F(ServiceTest, RemovingAQueuedJobLeavesTheOthers) {
  Gate gate(executor);
  Service service(options(), executor);
  const JobRow first = service.queue().submit({job_document()}).row;
  const JobRow second = service.queue().submit({job_document()}).row;
  const JobRow third = service.queue().submit({job_document()}).row;
  EXPECT_TRUE(service.housekeeping().remove(second.id));
  gate.open();
  EXPECT_TRUE(reaches(service, third.id, JobState::succeeded));
  EXPECT_EQ(service.queue().get(first.id)->state, JobState::succeeded);
  EXPECT_FALSE(service.queue().get(second.id));
}

TEST_F(ServiceTest, ManyClientsAtOnce) {
  Service service(options(), executor);
  constexpr int kClients = 4;
  {
    std::vector<std::jthread> clients(kClients);
    for (std::size_t client = 0; client < clients.size(); ++client) {
      clients[client] = std::jthread([&, client] {
        for (int i = 0; i < 5; ++i) {
          const JobRow row = service.queue().submit({job_document()}).row;
          service.queue().list({.limit = 10});
          if (client % 2 == 0) {
            EXPECT_TRUE(service.housekeeping().remove(row.id));
          } else {
            EXPECT_TRUE(service.queue().get(row.id));
          }
        }
      });
    }
  }
  EXPECT_EQ(service.queue().list({.limit = 100}).size(), 10U);
  EXPECT_TRUE(wait_until([&] {
    for (const JobRow& row : service.queue().list({.limit = 100})) {
      if (row.state != JobState::succeeded) return false;
    }
    return true;
  }));
}

TEST_F(ServiceTest, AJobMayEndWithSomeOfItsRuns) {
  const std::string place = data.path().string();
  std::atomic<bool> fails = true;
  executor.before = [&](const Task& task) {
    return task.run == 1 && task.kind == Task::Kind::simulate && fails
               ? TaskResult{Outcome::out_of_memory, 3, "no memory for " + place + "/x", {}}
               : TaskResult{};
  };
  Service service(options(), executor);
  const std::string job = R"({"scenario": "yard", "runs": 2, "capture": {"to_s": 2}})";
  const std::string id = service.queue().submit({json::parse(job)}).row.id;
  ASSERT_TRUE(reaches(service, id, JobState::partial));
  const json error = json::parse(service.queue().get(id)->error_json);
  EXPECT_EQ(error["kind"], "partial");
  ASSERT_EQ(error["runs"].size(), 1U);
  EXPECT_EQ(error["runs"][0]["run"], "run001");
  EXPECT_EQ(error["runs"][0]["message"], "run001/trace: no memory for x (after 3 attempts)");
  EXPECT_TRUE(std::filesystem::exists(service.folders().dataset_folder(id)));
  EXPECT_GT(service.queue().get(id)->bytes, 0);
  fails = false;
  EXPECT_TRUE(service.queue().retry(id));
  ASSERT_TRUE(reaches(service, id, JobState::succeeded));
  EXPECT_EQ(service.queue().get(id)->error_json, "");
}

TEST_F(ServiceTest, AFullDiskLetsTheQueueRest) {
  std::atomic<std::int64_t> free = 1000;
  Service service(on_small_disk(free), executor);
  const std::string id = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(wait_until([&] { return !service.queue().paused().empty(); }));
  EXPECT_EQ(service.queue().get(id)->state, JobState::running) << "nothing has failed";
  EXPECT_NE(service.queue().get(id)->waiting_for, "");
  const std::string queued = service.queue().submit({job_document()}).row.id;
  executor.before = [](const Task&) { return TaskResult{}; };
  free = 110;  // a little is not enough
  const int looks_before = looks;
  ASSERT_TRUE(wait_until([&] { return looks >= looks_before + 3; }));  // two were acted on
  EXPECT_NE(service.queue().paused(), "");
  EXPECT_EQ(service.queue().get(queued)->state, JobState::queued);
  free = 1000;
  ASSERT_TRUE(reaches(service, id, JobState::succeeded));
  ASSERT_TRUE(reaches(service, queued, JobState::succeeded));
  EXPECT_EQ(service.queue().paused(), "");
  EXPECT_EQ(service.queue().get(id)->waiting_for, "");
}

TEST_F(ServiceTest, AJobThatFillsTheDiskAgainAndAgainFails) {
  std::atomic<std::int64_t> free = 1000;
  Service service(on_small_disk(free), executor);
  const std::string large = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(wait_until([&] { return !service.queue().paused().empty(); }));
  free = 1000;
  ASSERT_TRUE(reaches(service, large, JobState::failed));
  const std::string error = service.queue().get(large)->error_json;
  EXPECT_THAT(error, HasSubstr("too small for this job"));
  EXPECT_THAT(error, HasSubstr("estimated at"));
  EXPECT_FALSE(std::filesystem::exists(service.folders().job_folder(large) / "work"));
  executor.before = [](const Task&) { return TaskResult{}; };
  free = 1000;
  ASSERT_TRUE(
      reaches(service, service.queue().submit({job_document()}).row.id, JobState::succeeded));
}

TEST_F(ServiceTest, AJobThatRunsSurvivesTheLossOfTheLock) {
  const std::filesystem::path lock = data.path() / "lock";
  const std::filesystem::path away = data.path() / "lock.away";
  std::atomic<bool> was_lost = false;
  executor.before = [&](const Task& task) {
    // The reports of the task cannot be stored then.
    if (task.kind == Task::Kind::render && !was_lost.exchange(true)) {
      std::filesystem::rename(lock, away);
    }
    return TaskResult{};
  };
  Service service(options(), executor);
  const std::string id = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(wait_until([&] { return was_lost.load(); }));
  EXPECT_TRUE(service.queue().submit({job_document()}).is_new) << "the lock is taken again";
  std::filesystem::rename(away, lock);
  EXPECT_TRUE(reaches(service, id, JobState::succeeded));
}

TEST_F(ServiceTest, NoSecondServiceStartsWhateverFilesAreRemoved) {
  const auto first = std::make_unique<Service>(options(), executor);
  Gate gate(executor);
  const std::string id = first->queue().submit({job_document()}).row.id;
  ASSERT_TRUE(wait_until([&] { return gate.somebody_waits(); }));
  jobs::FakeExecutor other;
  for (const char* name : {"lock", "reserve", "keys.sqlite"}) {
    std::filesystem::remove(data.path() / name);
    EXPECT_THROW(Service(options(), other), EnvironmentError) << name;
  }
  ServiceOptions elsewhere = options();
  const jobs::TemporaryFolder database;
  elsewhere.database = database.path();
  EXPECT_THROW(Service(elsewhere, other), EnvironmentError) << "it would take the jobs for strange";
  EXPECT_TRUE(std::filesystem::exists(first->folders().job_folder(id)));
  gate.open();
  EXPECT_TRUE(reaches(*first, id, JobState::succeeded));
  EXPECT_TRUE(other.done().empty());
}

TEST_F(ServiceTest, OtherUsersOfTheMachineEnterNoFolder) {
  // An earlier version has made them; the umask of the process is for new ones.
  for (const char* name : {"jobs", "uploads", "quarantine"}) {
    std::filesystem::create_directories(data.path() / name);
  }
  const Service service(options(), executor);
  for (const char* name : {"jobs", "uploads", "quarantine"}) {
    EXPECT_EQ(std::filesystem::status(data.path() / name).permissions(),
              std::filesystem::perms::owner_all)
        << name;
  }
}

TEST_F(ServiceTest, RetryHealsTheNoteOfTheCharacters) {
  std::atomic<bool> is_broken = true;
  executor.before_in = [&](const jobs::JobFolder& folder, const Task& task) {
    if (task.kind == Task::Kind::collect && is_broken.exchange(false)) {
      write_file_atomically(folder.path() / "work/people", "damaged");
      return TaskResult{Outcome::input_error, 1, "boom", {}};
    }
    return TaskResult{};
  };
  Service service(options(), executor);
  const std::string id = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(reaches(service, id, JobState::failed));
  const std::filesystem::path work = service.folders().job_folder(id) / "work";
  ASSERT_TRUE(std::filesystem::exists(work / "run000/shard0000"));
  Gate gate(executor);
  ASSERT_TRUE(service.queue().retry(id));
  EXPECT_FALSE(std::filesystem::exists(work / "people"));
  EXPECT_FALSE(std::filesystem::exists(work / "run000/shard0000")) << "nobody knows its characters";
  gate.open();
  EXPECT_TRUE(reaches(service, id, JobState::succeeded));
}

TEST_F(ServiceTest, EstimatesCountAmongTheBytesOfAKey) {
  Gate gate(executor);
  Service service(options(), executor);
  const auto submit = [&](std::int64_t max_bytes) {
    return service.queue()
        .submit({.job = job_document(), .owner = "me", .max_bytes = max_bytes})
        .row;
  };
  const std::int64_t planned = submit(1LL << 40U).planned_bytes;
  EXPECT_GT(planned, 0);
  EXPECT_THROW(submit(planned), QuotaError);
  EXPECT_THROW(submit(2 * planned - 1), QuotaError);
  submit(2 * planned);
  gate.open();
}

TEST_F(ServiceTest, AJobLargerThanTheDiskIsRefused) {
  Service service(options(), executor);
  constexpr std::int64_t kPlannedBytes = 20'000'000'000'000;
  if (measure_disk(service.folders().data()).total_bytes > kPlannedBytes) GTEST_SKIP();
  constexpr const char* kLarge = R"({"scenario": "yard", "runs": 1000, "capture": {"to_s": 150,
 "rate_hz": 10}, "drones": [{"id": "d1", "start": [0, 0, 20], "camera": {"width": 7680, "height":
 4320}}], "outputs": {"annotations": ["coco", "depth", "flow"]}})";
  const auto refusal = [&](const auto& ask) -> std::string {
    try {
      ask();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string expected = "of the service's disk";
  EXPECT_THAT(refusal([&] { service.queue().submit({.job = nlohmann::json::parse(kLarge)}); }),
              HasSubstr(expected));
  EXPECT_THAT(refusal([&] { service.queue().dry_run(nlohmann::json::parse(kLarge)); }),
              HasSubstr(expected));
  EXPECT_TRUE(service.queue().list({}).empty());
}

// Not refused, as others may end and leave room.
TEST_F(ServiceTest, ADryRunWarnsOfAJobLargerThanTheFreeDisk) {
  Service service(options(), executor);
  const auto dry_run = [&](std::int64_t runs) {
    json job = json::parse(R"({"scenario": "yard", "capture": {"to_s": 10, "rate_hz": 10},
        "drones": [{"id": "d1", "start": [0, 0, 20], "camera": {"width": 7680, "height": 4320}}],
        "outputs": {"annotations": ["coco", "depth", "flow"]}})");
    job["runs"] = runs;
    return service.queue().dry_run(job);
  };
  const json small = dry_run(1);
  EXPECT_THAT(small["warnings"].dump(), Not(HasSubstr("free on the service's disk")));
  const auto run_bytes = small["estimate"]["disk_bytes"].get<std::int64_t>();
  const DiskState disk = measure_disk(service.folders().data());
  const std::int64_t runs = disk.free_bytes / run_bytes + 2;
  if (runs > 1000 || (runs + 1) * run_bytes > disk.total_bytes) GTEST_SKIP() << "an empty disk";
  EXPECT_THAT(dry_run(runs)["warnings"].dump(), HasSubstr("free on the service's disk"));
}

TEST_F(ServiceTest, JobsTeachTheSpeedOfTheMachine) {
  executor.before_in = [](const jobs::JobFolder&, const Task&) {
    return TaskResult{Outcome::succeeded, 1, "", {}, 1e6};
  };
  Service service(options(), executor);
  const json before = service.queue().dry_run(job_document())["estimate"];
  EXPECT_EQ(before["basis"], "reference machine");
  const JobRow row = service.queue().submit({job_document()}).row;
  ASSERT_TRUE(reaches(service, row.id, JobState::succeeded));
  const json after = service.queue().dry_run(job_document())["estimate"];
  EXPECT_EQ(after["basis"], "this machine");
  EXPECT_NEAR(after["cpu_s"].get<double>(), 8 * before["cpu_s"].get<double>(), 0.5);
}

TEST_F(ServiceTest, AReadOnlyOrFullDiskLetsTheQueueRestWithoutALimitToo) {
  std::atomic<bool> is_read_only = false;
  std::atomic<std::int64_t> free = 1LL << 30;
  ServiceOptions limited = options();
  limited.housekeeping.disk = [&] { return DiskState{free.load(), is_read_only.load()}; };
  limited.housekeeping.min_free_bytes = 0;
  std::atomic<bool> was_read_only = false;
  executor.before = [&](const Task& task) {
    if (task.kind == Task::Kind::render && !was_read_only.exchange(true)) is_read_only = true;
    return is_read_only ? TaskResult{Outcome::environment_error, 3, "read-only file system", {}}
                        : TaskResult{};
  };
  Service service(limited, executor);
  const std::string id = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(wait_until([&] { return service.queue().paused() == "the disk is read-only"; }));
  EXPECT_EQ(service.queue().get(id)->state, JobState::running) << "nothing has failed";
  free = 0;
  is_read_only = false;
  const auto is_full = [&] { return service.queue().paused().starts_with("the disk is full"); };
  ASSERT_TRUE(wait_until(is_full));
  EXPECT_TRUE(service.queue().get(id)->waiting_for.starts_with("the disk is full"));
  free = 1LL << 30;
  ASSERT_TRUE(reaches(service, id, JobState::succeeded));
}

TEST_F(ServiceTest, RetryHealsAJobWhoseFilesWereDeletedOrDamaged) {
  namespace fs = std::filesystem;
  std::atomic<bool> fails = true;
  executor.before = [&](const Task& task) {
    return fails && task.kind == Task::Kind::collect
               ? TaskResult{Outcome::environment_error, 3, "broken", {}}
               : TaskResult{};
  };
  Service service(options(), executor);
  const auto damages = {
      +[](const fs::path& job) { fs::remove_all(job); },
      +[](const fs::path& job) { fs::remove_all(job / "work"); },
      +[](const fs::path& job) { fs::remove(job / "job.json"); },
      +[](const fs::path& job) { write_file_atomically(job / "job.json", "{\"scen"); },
      +[](const fs::path& job) {
        for (const auto& run : fs::directory_iterator(job / "work")) fs::remove_all(run);
      },
      +[](const fs::path& job) {
        for (const char* name : {"work", "logs", "attempts", "dataset"}) {
          fs::remove_all(job / name);
          write_file_atomically(job / name, "");
        }
      },
      +[](const fs::path& job) { fs::create_directory(job / "dataset"); },
      +[](const fs::path& job) {
        fs::create_directory(job / "dataset");
        write_file_atomically(job / "dataset/dataset.json", "{}");
      },
      +[](const fs::path& job) {
        for (const char* name : {"trace.h5", "metrics", "shard0000"}) {
          fs::remove_all(job / "work/run000" / name);
          fs::create_directory(job / "work/run000" / name);
        }
      },
      +[](const fs::path& job) {
        for (const char* name : {"trace.h5.sha256", "metrics", "shard0000"}) {
          fs::remove_all(job / "work/run000" / name);
        }
        write_file_atomically(job / "work/run000/trace.h5", "tra");
      },
      +[](const fs::path& job) {
        fs::remove(job / "job.json");
        fs::create_directory(job / "job.json");
      },
      +[](const fs::path& job) {
        fs::remove_all(job);
        write_file_atomically(job, "");
      }};
  for (const auto& damage : damages) {
    fails = true;
    const std::string id = service.queue().submit({job_document()}).row.id;
    ASSERT_TRUE(reaches(service, id, JobState::failed));
    damage(service.folders().job_folder(id));
    fails = false;
    ASSERT_TRUE(service.queue().retry(id, {}));
    EXPECT_TRUE(reaches(service, id, JobState::succeeded)) << service.queue().get(id)->error_json;
    EXPECT_TRUE(fs::exists(service.folders().dataset_folder(id) / "manifest.json"));
    EXPECT_EQ(read_file(service.folders().job_folder(id) / "work/run000/trace.h5"), "trace");
  }
}

TEST_F(ServiceTest, AJobIsTakenUpAgainAfterTheMachineLackedFiles) {
  std::atomic<int> lacks = 2;
  executor.before = [&](const Task& task) {
    if (task.kind == Task::Kind::render && lacks-- > 0) {
      throw ResourcesExhausted("cannot create a pipe: Too many open files");
    }
    return TaskResult{};
  };
  Service service(options(), executor);
  const std::string id = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(reaches(service, id, JobState::succeeded)) << service.queue().get(id)->error_json;
}

TEST_F(ServiceTest, ExpiredJobsAreRemoved) {
  std::atomic<std::int64_t> now_ms = 1'700'000'000'000;
  ServiceOptions keeping = options();
  keeping.clock = [&] { return now_ms.load(); };
  keeping.steady = keeping.clock;
  keeping.housekeeping.retention.max_wait_ms = 1000;
  Service service(keeping, executor);
  const std::string old = service.queue().submit({job_document()}).row.id;
  const std::string kept = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(reaches(service, kept, JobState::succeeded));
  service.queue().change(kept, {.keep = true});
  now_ms += 999;
  service.housekeeping().remove_expired();
  EXPECT_TRUE(service.queue().get(old));
  now_ms += 1;
  const std::string fresh = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(reaches(service, fresh, JobState::succeeded));
  service.housekeeping().remove_expired();
  EXPECT_FALSE(service.queue().get(old));
  EXPECT_FALSE(std::filesystem::exists(service.folders().job_folder(old)));
  EXPECT_TRUE(service.queue().get(kept));
  EXPECT_TRUE(service.queue().get(fresh));
}

TEST_F(ServiceTest, JobsAreKeptAsLongWhateverTheClockIsSetTo) {
  constexpr std::int64_t kYearMs = 31'536'000'000;
  std::atomic<std::int64_t> wall_ms = 1'700'000'000'000;
  std::atomic<std::int64_t> steady_ms = 5'000;
  ServiceOptions keeping = options();
  keeping.clock = [&] { return wall_ms.load(); };
  keeping.steady = [&] { return steady_ms.load(); };
  keeping.housekeeping.retention.max_wait_ms = 1000;
  Service service(keeping, executor);
  const std::string a = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(reaches(service, a, JobState::succeeded));
  for (const std::int64_t jump : {10 * kYearMs, -20 * kYearMs}) {
    wall_ms += jump;
    service.housekeeping().remove_expired();
    ASSERT_TRUE(service.queue().get(a));
  }
  wall_ms += 20 * kYearMs;
  const std::string b = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(reaches(service, b, JobState::succeeded));
  wall_ms -= 15 * kYearMs;
  steady_ms += 1000;
  service.housekeeping().remove_expired();
  EXPECT_FALSE(service.queue().get(a));
  EXPECT_FALSE(service.queue().get(b));
}

TEST_F(ServiceTest, NothingIsAcceptedOnceTheStoreWasRemoved) {
  Service service(options(), executor);
  const std::string id = service.queue().submit({job_document()}).row.id;
  ASSERT_TRUE(reaches(service, id, JobState::succeeded));
  const std::filesystem::path file = data.path() / "jobs.sqlite";
  std::filesystem::rename(file, data.path() / "aside");
  EXPECT_THROW(service.queue().submit({job_document()}), EnvironmentError);
  EXPECT_THROW(service.queue().check_store(), EnvironmentError);
  write_file_atomically(file, "");  // another is not the same
  EXPECT_THROW(service.queue().submit({job_document()}), EnvironmentError);
  std::filesystem::rename(data.path() / "aside", file);
  EXPECT_TRUE(service.queue().submit({job_document()}).is_new);
}

TEST_F(ServiceTest, NothingIsAcceptedOnceAnotherProcessHasTheLock) {
  Service service(options(), executor);
  std::filesystem::remove(data.path() / "lock");
  const jobs::FolderLock other(data.path(), "lock", "data folder");
  EXPECT_THROW(service.queue().submit({job_document()}), EnvironmentError);
}

}  // namespace
}  // namespace throng::server
