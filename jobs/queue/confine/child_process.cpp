#include "jobs/queue/confine/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <utility>

#include "base/error.h"
#include "base/files/untrusted_folders.h"
#include "base/resource_exhaustion.h"
#include "jobs/queue/confine/credentials.h"
#include "jobs/queue/confine/file_fence.h"

namespace throng::jobs {

namespace {

// A line longer than this is no message of ours; it is cut so that memory stays bounded.
constexpr std::size_t kMaxLineBytes = 1 << 20;

// posix_spawn's argument objects, released in any case.
class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

/// Files that credentials are read from, with colons between them as in $PATH.
std::string credential_files() {
  std::string files;
  for (const char* name : {"AWS_SHARED_CREDENTIALS_FILE", "AWS_CONFIG_FILE"}) {
    const char* file = std::getenv(name);
    if (file == nullptr || *file == '\0') continue;
    files += (files.empty() ? "" : ":") + std::filesystem::absolute(file).string();
  }
  return files;
}

/// Removes the credentials from the variables; -1 if there are none.
int taken_credentials(ChildProcess::Variables& variables) {
  const auto end = std::stable_partition(
      variables.begin(), variables.end(),
      [](const auto& variable) { return !is_secret_variable(variable.first); });
  const ChildProcess::Variables credentials(end, variables.end());
  variables.erase(end, variables.end());
  return credentials.empty() ? -1 : descriptor_of_credentials(credentials);
}

std::vector<std::string> changed_environment(ChildProcess::Variables variables) {
  if (const std::string files = credential_files(); !files.empty()) {
    variables.emplace_back(kPrivateCredentialsVariable, files);
  }
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    bool replaced = is_secret_variable(text.substr(0, text.find('=')));
    for (const auto& [name, value] : variables) replaced |= text.starts_with(name + "=");
    if (!replaced) environment.push_back(text);
  }
  for (const auto& [name, value] : variables) {
    environment.push_back(fmt::format("{}={}", name, value));
  }
  return environment;
}

double seconds(const timeval& time) {
  constexpr double kMicrosecondS = 1e-6;
  return static_cast<double>(time.tv_sec) + kMicrosecondS * static_cast<double>(time.tv_usec);
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, Variables variables,
                           const std::filesystem::path& log, int input) {
  std::filesystem::create_directories(log.parent_path());
  const int log_file = open_for_appending(log);
  if (log_file < 0) throw_environment_error(fmt::format("cannot open {}", log.string()), errno);
  std::array<int, 2> pipe_ends{};
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    ::close(log_file);
    throw_environment_error("cannot create a pipe", error);
  }
  const auto [read_end, write_end] = pipe_ends;
  ::fcntl(read_end, F_SETFL, O_NONBLOCK);

  const int credentials = taken_credentials(variables);
  if (credentials >= 0) input = credentials;
  SpawnSettings settings;
  if (input < 0) {
    posix_spawn_file_actions_addopen(&settings.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  } else {
    posix_spawn_file_actions_adddup2(&settings.actions, input, STDIN_FILENO);
  }
  posix_spawn_file_actions_adddup2(&settings.actions, write_end, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&settings.actions, log_file, STDERR_FILENO);
  // Libraries open sockets and files without a word: a child gets none of a client's connection.
  posix_spawn_file_actions_addclosefrom_np(&settings.actions, STDERR_FILENO + 1);
  // A server blocks and ignores signals that a worker must obey.
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&settings.attributes, &none);
  posix_spawnattr_setsigdefault(&settings.attributes, &all);
  posix_spawnattr_setpgroup(&settings.attributes, 0);
  posix_spawnattr_setflags(&settings.attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::vector<std::string> arguments = command;
  std::vector<std::string> environment = changed_environment(std::move(variables));
  const int error =
      ::posix_spawnp(&pid_, arguments[0].c_str(), &settings.actions, &settings.attributes,
                     pointers_to(arguments).data(), pointers_to(environment).data());
  ::close(write_end);
  ::close(log_file);
  if (credentials >= 0) ::close(credentials);
  if (error != 0) {
    ::close(read_end);
    throw_environment_error(fmt::format("cannot start {}", command[0]), error);
  }
  output_ = read_end;
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    signal_group(SIGKILL);
    wait();
  }
  ::close(output_);
}

std::vector<std::string> ChildProcess::read_lines() {
  std::array<char, 4096> block{};
  ssize_t count = 0;
  while ((count = ::read(output_, block.data(), block.size())) > 0) {
    pending_.append(block.data(), static_cast<std::size_t>(count));
    if (pending_.size() > kMaxLineBytes) pending_.clear();
  }
  std::vector<std::string> lines;
  std::size_t start = 0;
  for (auto end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n', start)) {
    lines.push_back(pending_.substr(start, end - start));
    start = end + 1;
  }
  pending_.erase(0, start);
  return lines;
}

bool ChildProcess::has_ended() const {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid_;
}

ExitStatus ChildProcess::wait() {
  // While the leader is uncollected its number, and so the group's, cannot be given to others.
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT) != 0 &&
         errno == EINTR) {
  }
  signal_group(SIGKILL);
  int status = 0;
  rusage used{};
  while (::wait4(pid_, &status, 0, &used) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  const double cpu_s = seconds(used.ru_utime) + seconds(used.ru_stime);
  if (WIFSIGNALED(status)) return {0, WTERMSIG(status), cpu_s};
  return {WEXITSTATUS(status), 0, cpu_s};
}

void ChildProcess::signal_group(int signal) const {
  if (pid_ > 0) ::kill(-pid_, signal);
}

}  // namespace throng::jobs
