// The process of a flight that cannot begin: its service gets a message and an exit code.
#include "live/flight/session.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "base/files/files.h"
#include "jobs/queue/workers/worker_interface.h"
#include "spec/live/messages.h"
#include "tests/jobs/yard.h"

namespace throng::live {
namespace {

struct Ended {
  int code = -1;           ///< -1: by a signal
  nlohmann::json failure;  ///< the only message
};

/// A session confines its process, and so has one of its own.
Ended fly_in(const jobs::TemporaryFolder& folder) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
    ::_exit(run_session(folder.path(), {}));
  }
  ::close(ends[1]);
  MessageReader reader;
  std::array<char, 1000> block{};
  for (ssize_t count = 0; (count = ::read(ends[0], block.data(), block.size())) > 0;) {
    reader.add({block.data(), static_cast<std::size_t>(count)});
  }
  ::close(ends[0]);
  Ended ended;
  if (const auto message = reader.next()) {
    EXPECT_EQ(message->type, MessageType::failure);
    ended.failure = nlohmann::json::parse(message->bytes);
  }
  EXPECT_FALSE(reader.next());
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  return ended;
}

TEST(Session, WithoutItsJobFailsByTheMachine) {
  const jobs::TemporaryFolder folder;
  const Ended ended = fly_in(folder);
  EXPECT_EQ(ended.code, jobs::worker_environment_error);
  EXPECT_EQ(ended.failure.at("kind"), "environment");
  EXPECT_EQ(ended.failure.at("message"), "cannot read job.json: No such file or directory");
  EXPECT_EQ(ended.failure.at("problems").size(), 0U);
}

TEST(Session, WithAnUnknownScenarioNamesItsField) {
  const jobs::TemporaryFolder folder;
  write_file_atomically(folder.path() / "job.json", R"({"scenario": "no_such_place"})");
  const Ended ended = fly_in(folder);
  EXPECT_EQ(ended.code, jobs::worker_input_error);
  EXPECT_EQ(ended.failure.at("kind"), "input");
  EXPECT_EQ(ended.failure.at("problems").at(0).at("where"), "/scenario");
}

}  // namespace
}  // namespace throng::live
