#include "jobs/queue/workers/worker_attempt.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/staging.h"
#include "base/json/json_text.h"
#include "base/resource_exhaustion.h"
#include "jobs/queue/workers/attempts.h"
#include "jobs/queue/workers/worker_protocol.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kMode = 0644;

// The messages, to be written to when the worker has handed stdout to its own Reporter.
int messages = -1;
std::chrono::steady_clock::time_point begun;

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return;  // a full disk: the exit code says the rest
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  ::fdatasync(descriptor);  // others wait for it on other machines
}

/// Writes who began the attempt. Of several processes one succeeds.
void claim(const fs::path& folder) {
  const fs::path file = folder / "claim";
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  if (descriptor < 0 && errno == EEXIST) {
    throw EnvironmentError(
        fmt::format("{}: another process has begun this attempt", folder.string()));
  }
  if (descriptor < 0 && errno == ENOENT) {
    throw EnvironmentError(
        fmt::format("{}: the attempt was taken back before it began", folder.string()));
  }
  if (descriptor < 0) throw_environment_error("cannot create " + file.string(), errno);
  write_all(descriptor, json{{"node", name_of_this_host()}, {"pid", ::getpid()}}.dump() + "\n");
  ::close(descriptor);
}

int opened(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kMode);
  if (descriptor < 0) throw_environment_error("cannot open " + file.string(), errno);
  return descriptor;
}

}  // namespace

std::string begin_attempt(const fs::path& job_folder, const std::string& array, int index) {
  const JobFolder folder(job_folder);
  const fs::path own = attempt_folder(folder, array, static_cast<std::size_t>(index));
  claim(own);
  const fs::path file = array_folder(folder, array) / "array.json";
  const json value = parse_own_json(read_file(file), file.string());
  const json& task = value.at("tasks").at(static_cast<std::size_t>(index));
  const auto name = task.at("task").get<std::string>();
  for (const auto& [variable, text] :
       value.at("variables").get<std::vector<std::pair<std::string, std::string>>>()) {
    ::setenv(variable.c_str(), text.c_str(), 1);
  }
  ::setenv(kAttemptVariable, std::to_string(task.at("attempt").get<int>()).c_str(), 1);
  ::unsetenv(kSupervisorVariable);
  const fs::path log = folder.log_file(name);
  make_folders(log.parent_path());
  const int log_descriptor = opened(log);
  ::dup2(log_descriptor, STDERR_FILENO);
  ::close(log_descriptor);
  messages = opened(own / "messages");
  ::dup2(messages, STDOUT_FILENO);
  stage_in(own);
  begun = std::chrono::steady_clock::now();
  return name;
}

void end_attempt(const fs::path& job_folder, int exit_code) {
  const auto took = std::chrono::steady_clock::now() - begun;
  AttemptEnd end{exit_code, std::chrono::duration<double>(took).count(), {}};
  for (const fs::path& path : published_files()) {
    end.published.push_back(path.lexically_relative(job_folder).string());
  }
  write_all(messages, attempt_end_line(end) + "\n");
}

}  // namespace throng::jobs
