// A worker as its supervisor sees it: what it says, how it ends, what it may do.
#include "jobs/queue/workers/worker_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/queue/confine/worker_limits.h"
#include "jobs/queue/workers/worker_protocol.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

/// The end of a process and what it has said.
struct Ended {
  int code = -1;  ///< -1: by a signal
  std::string said;
};

std::string word_for(const WorkerError& error) {
  std::string word = error.kind + ": " + error.message;
  for (const Problem& problem : error.problems) word += " [" + problem.source + "]";
  return word;
}

/// A process is confined for good, so each test has one of its own.
class WorkerProcessTest : public testing::Test {
 protected:
  Ended run(
      const std::function<void(WorkerProcess&)>& work,
      const std::function<void()>& prepare = [] {}) const {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      prepare();
      WorkerProcess process({.folder = folder_.path(), .unnamed = {other_.path()}});
      ::_exit(process.run([&] { work(process); }, word_for));
    }
    ::close(ends[1]);
    Ended ended;
    std::array<char, 1000> block{};
    for (ssize_t count = 0; (count = ::read(ends[0], block.data(), block.size())) > 0;) {
      ended.said.append(block.data(), static_cast<std::size_t>(count));
    }
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
    return ended;
  }

  TemporaryFolder folder_;
  TemporaryFolder other_;
};

TEST_F(WorkerProcessTest, SaysOnlyWhatItSends) {
  const Ended ended = run([](WorkerProcess& process) {
    process.send("one ");
    std::puts("a driver's line");
    std::fflush(stdout);
    process.send("two");
  });
  EXPECT_EQ(ended.said, "one two");
  EXPECT_EQ(ended.code, worker_succeeded);
}

TEST_F(WorkerProcessTest, NamesEachKindOfFailureAndNoFolder) {
  const std::string file = (folder_.path() / "job.json").string();
  const Ended input = run([&](WorkerProcess&) {
    throw InputError({(other_.path() / "plaza.json").string(), "/a", "1", "2"});
  });
  EXPECT_EQ(input.code, worker_input_error);
  EXPECT_EQ(input.said, "input: plaza.json: /a: found 1, expected 2 [plaza.json]");
  const Ended environment =
      run([&](WorkerProcess&) { throw EnvironmentError("cannot read " + file); });
  EXPECT_EQ(environment.code, worker_environment_error);
  EXPECT_EQ(environment.said, "environment: cannot read job.json");
  const Ended bug = run([&](WorkerProcess&) { throw std::logic_error("no such key in " + file); });
  EXPECT_EQ(bug.code, worker_bug);
  EXPECT_EQ(bug.said, "bug: no such key in job.json");
}

TEST_F(WorkerProcessTest, TellsALackOfMemoryFromOtherProblems) {
  const Ended lack = run([](WorkerProcess&) { throw std::bad_alloc(); });
  EXPECT_EQ(lack.code, worker_out_of_memory);
  EXPECT_EQ(lack.said, "environment: out of memory: what this process may use does not suffice");
  const auto lack_a_thread = [](WorkerProcess&) {
    throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
  };
  EXPECT_EQ(run(lack_a_thread).code, worker_environment_error);
  const auto limit = [] { ::setenv(kDataVariable, "0", 1); };
  EXPECT_EQ(run(lack_a_thread, limit).said, lack.said);
}

TEST_F(WorkerProcessTest, WritesInItsFolderOnly) {
  const Ended ended = run([&](WorkerProcess& process) {
    write_file_atomically(folder_.path() / "mine", "x");
    process.send("written ");
    write_file_atomically(other_.path() / "theirs", "x");
  });
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "mine"));
  EXPECT_TRUE(ended.said.starts_with("written "));
  if (ended.code == worker_succeeded) GTEST_SKIP() << "the kernel has no Landlock";
  EXPECT_EQ(ended.code, worker_environment_error);
  EXPECT_FALSE(std::filesystem::exists(other_.path() / "theirs"));
}

TEST_F(WorkerProcessTest, DoesNothingForASupervisorThatIsGone) {
  const auto work = [](WorkerProcess& process) { process.send("begun"); };
  const auto supervisor = [](pid_t pid) {
    return [pid] { ::setenv(kSupervisorVariable, std::to_string(pid).c_str(), 1); };
  };
  EXPECT_EQ(run(work, supervisor(::getpid())).said, "begun");
  const Ended orphan = run(work, supervisor(1));
  EXPECT_EQ(orphan.said, "");
  EXPECT_EQ(orphan.code, worker_environment_error);
}

}  // namespace
}  // namespace throng::jobs
