#include "jobs/queue/workers/attempts.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/staging.h"
#include "jobs/queue/slurm/message_file_reader.h"
#include "jobs/queue/workers/worker_attempt.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

namespace fs = std::filesystem;

// In a process of its own: staging is chosen for good.
int run_for_exit_code(const std::function<int()>& work) {
  const pid_t pid = ::fork();
  if (pid == 0) ::_exit(work());
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class AttemptsTest : public testing::Test {
 protected:
  AttemptsTest() {
    array.attempts = {{"run000/trace", 1}, {"run001/trace", 2}};
    array.variables = {{"THRONG_TEST_VARIABLE", "set"}};
    create_attempts(folder, array);
  }

  TemporaryFolder base;
  JobFolder folder{base.path()};
  AttemptArray array;
};

TEST_F(AttemptsTest, AreReadAsTheyWereMade) {
  note_array_job(folder, array.name, "17");
  const auto read = read_attempts(folder);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].name, array.name);
  ASSERT_EQ(read[0].attempts.size(), 2U);
  EXPECT_EQ(read[0].attempts[1].task, "run001/trace");
  EXPECT_EQ(read[0].attempts[1].number, 2);
  EXPECT_EQ(noted_array_job(folder, array.name), "17");
  EXPECT_FALSE(find_claim(folder, array.name, 0));
  remove_attempts(folder, array.name);
  EXPECT_FALSE(fs::exists(attempts_folder(folder)));
}

TEST_F(AttemptsTest, OnesWhoseMakingWasBrokenOffAreRemoved) {
  fs::create_directories(attempts_folder(folder) / "half" / "0");
  EXPECT_EQ(read_attempts(folder).size(), 1U);
  EXPECT_FALSE(fs::exists(attempts_folder(folder) / "half"));
}

TEST_F(AttemptsTest, AWorkerBeginsSaysAndPublishes) {
  const int code = run_for_exit_code([&] {
    if (begin_attempt(folder.path(), array.name, 1) != "run001/trace") return 1;
    if (std::string(std::getenv("THRONG_TEST_VARIABLE")) != "set") return 2;
    if (std::string(std::getenv("THRONG_ATTEMPT")) != "2") return 3;
    write_file_atomically(folder.path() / "work/run001/trace.h5", "trace");
    StagingFolder staging(folder.path() / "work/run001/shard0000");
    write_file_atomically(staging.path() / "files/image", "part of the folder");
    staging.commit();
    end_attempt(folder.path(), 0);
    return 0;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(read_file(folder.path() / "work/run001/trace.h5"), "trace");
  ASSERT_TRUE(find_claim(folder, array.name, 1));
  EXPECT_EQ(find_claim(folder, array.name, 1)->node, name_of_this_host());
  MessageFileReader messages(attempt_folder(folder, array.name, 1) / "messages");
  EXPECT_TRUE(messages.read());
  ASSERT_TRUE(messages.end());
  EXPECT_EQ(messages.end()->code, 0);
  const std::vector<std::string> published = {"work/run001/trace.h5", "work/run001/shard0000"};
  EXPECT_EQ(messages.end()->published, published);
  EXPECT_EQ(read_file(folder.path() / "work/run001/shard0000/files/image"), "part of the folder");
  EXPECT_FALSE(messages.read()) << "nothing new";
}

TEST_F(AttemptsTest, AnAttemptBeginsOnce) {
  const auto begin = [&] {
    try {
      begin_attempt(folder.path(), array.name, 0);
      return 0;
    } catch (const EnvironmentError&) {
      return 1;
    }
  };
  EXPECT_EQ(run_for_exit_code(begin), 0);
  EXPECT_EQ(run_for_exit_code(begin), 1) << "Slurm has started the same attempt again";
}

TEST_F(AttemptsTest, OneThatWasTakenBackDoesNotBegin) {
  revoke_attempt(folder, array.name, 0);
  EXPECT_EQ(run_for_exit_code([&] {
              try {
                begin_attempt(folder.path(), array.name, 0);
                return 0;
              } catch (const EnvironmentError&) {
                return 1;
              }
            }),
            1);
  EXPECT_FALSE(fs::exists(attempt_folder(folder, array.name, 0)));
}

// A node that was cut off wakes up in the midst of its work: its supervisor has given the task to
// another one long ago.
TEST_F(AttemptsTest, NothingIsPublishedOnceTheRightIsTakenAway) {
  const fs::path output = folder.path() / "work/run000/shard0000";
  const fs::path file = folder.path() / "work/run000/trace.h5";
  const fs::path note = folder.path() / "work/people";
  const int code = run_for_exit_code([&] {
    begin_attempt(folder.path(), array.name, 0);
    StagingFolder staging(output);
    StagedFile staged(file);
    StagedFile once(note);
    staged.write("late");
    once.write("late");
    if (is_staging_revoked()) return 1;
    if (run_for_exit_code([&] {
          revoke_attempt(folder, array.name, 0);
          return 0;
        }) != 0) {
      return 2;
    }
    if (!is_staging_revoked()) return 3;
    // Writers make the folders that they need: the path is there again.
    fs::create_directories(staging.path() / "files");
    int refused = 0;
    for (const auto& publish : std::initializer_list<std::function<void()>>{
             [&] { staging.commit(); }, [&] { staged.commit(); }, [&] { once.commit_if_absent(); },
             [&] { write_file_atomically(file, "late"); }}) {
      try {
        publish();
      } catch (const EnvironmentError&) {
        ++refused;
      }
    }
    return refused == 4 ? 0 : 10 + refused;
  });
  EXPECT_EQ(code, 0);
  EXPECT_FALSE(fs::exists(output));
  EXPECT_FALSE(fs::exists(file));
  EXPECT_FALSE(fs::exists(note));
}

// Slurm begins a task again under its number, with a right of its own, while the process of a node
// that was cut off is still there.
TEST_F(AttemptsTest, ARenewedRightIsNotThatOfTheFirstProcess) {
  const fs::path output = folder.path() / "work/run000/shard0000";
  const int code = run_for_exit_code([&] {
    begin_attempt(folder.path(), array.name, 0);
    StagingFolder staging(output);
    if (run_for_exit_code([&] { return renew_attempt(folder, array.name, 0) ? 0 : 1; }) != 0)
      return 1;
    const auto begin = [&] {
      begin_attempt(folder.path(), array.name, 0);
      return is_staging_revoked() ? 1 : 0;
    };
    if (run_for_exit_code(begin) != 0) return 2;
    if (!is_staging_revoked()) return 3;
    fs::create_directories(staging.path() / "files");
    try {
      staging.commit();
    } catch (const EnvironmentError&) {
      return 0;
    }
    return 4;
  });
  EXPECT_EQ(code, 0);
  EXPECT_FALSE(fs::exists(output));
  EXPECT_TRUE(find_claim(folder, array.name, 0)) << "the second process has begun";
}

TEST_F(AttemptsTest, NamesOfStagedFilesNameTheirWriter) {
  const fs::path one = staging_path(base.path() / "file");
  const fs::path other = staging_path(base.path() / "file");
  EXPECT_NE(one, other);
  EXPECT_EQ(one.parent_path(), base.path());
  const std::string begin = "file.tmp." + name_of_this_host() + "." + std::to_string(::getpid());
  EXPECT_TRUE(one.filename().string().starts_with(begin)) << one;
}

}  // namespace
}  // namespace throng::jobs
