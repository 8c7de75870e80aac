#include "cli/shell/trace_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <exception>
#include <system_error>

#include "base/error.h"
#include "cli/shell/file_kind.h"

namespace throng::cli {

namespace fs = std::filesystem;

namespace {

// Far more than a sound file of that size takes, for files that make the library loop forever.
constexpr rlim_t kBaseCpuS = 20;
constexpr std::uintmax_t kBytesPerCpuS = 1'000'000;

void limit(__rlimit_resource resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(resource, &both);
}

// In the child: reports of sanitizers and of the C library about the crash are of no use.
void silence() {
  const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (null < 0) return;
  ::dup2(null, STDOUT_FILENO);
  ::dup2(null, STDERR_FILENO);
}

// Exits with 0 whatever the reader says: the parent reads again and gets the same exception.
[[noreturn]] void read_in_child(const fs::path& path) {
  silence();
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kBaseCpuS + static_cast<rlim_t>(error ? 0 : bytes / kBytesPerCpuS));
  try {
    world::read_trace(path);
  } catch (const std::exception&) {  // which the parent will throw
  }
  ::_exit(0);
}

// Signals that only the reading itself can have caused. Sanitizers exit with a code instead.
bool has_crashed(int status) {
  constexpr std::array kCrashes = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGKILL};
  if (WIFEXITED(status)) return WEXITSTATUS(status) != 0;
  return std::find(kCrashes.begin(), kCrashes.end(), WTERMSIG(status)) != kCrashes.end();
}

}  // namespace

world::Trace read_trace_file(const fs::path& path) {
  require_trace(path);
  const pid_t child = ::fork();
  if (child < 0) throw EnvironmentError(fmt::format("cannot start a process: errno {}", errno));
  if (child == 0) read_in_child(path);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (has_crashed(status)) {
    throw InputError(
        {path.string(), "", "a damaged HDF5 file, which cannot be read", "a trace (HDF5)"});
  }
  return world::read_trace(path);
}

}  // namespace throng::cli
