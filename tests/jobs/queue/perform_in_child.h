// The child's side of a confined task.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "jobs/queue/confine/confined_task.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {

/// The answer of run_confined_task() in a process of its own, as limits cannot be taken back.
inline nlohmann::json performed_in_child(
    const std::function<nlohmann::json(const nlohmann::json&)>& perform, int expected_code) {
  const TemporaryFolder work;
  write_file_atomically(work.path() / "request.json", R"({"n": 2})");
  const pid_t child = ::fork();
  if (child == 0) ::_exit(run_confined_task(work.path(), perform));
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), expected_code);
  const auto answer = work.path() / "answer.json";
  return std::filesystem::exists(answer) ? nlohmann::json::parse(read_file(answer))
                                         : nlohmann::json();
}

}  // namespace throng::jobs
