// A child process in a process group of its own, with its stdout as a pipe.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace throng::jobs {

/// How a process ended: with an exit code, or by a signal.
struct ExitStatus {
  int code = 0;
  int signal = 0;    ///< 0: none
  double cpu_s = 0;  ///< of the process, and of its children that it waited for
};

/// Owns one child process. Use from one thread at a time.
class ChildProcess {
 public:
  using Variables = std::vector<std::pair<std::string, std::string>>;

  /// Starts command[0] (searched in PATH) with this process's environment changed by `variables`.
  /// Secrets are removed from it (is_secret_variable()); those that `variables` contains are its
  /// stdin, which take_credentials() reads. $THRONG_PRIVATE_CREDENTIALS names their files
  /// (jobs/queue/confine/file_fence.h). stderr is appended to the file `log`; stdin is the
  /// descriptor `input`, or empty for -1. Throws EnvironmentError.
  ChildProcess(const std::vector<std::string>& command, Variables variables,
               const std::filesystem::path& log, int input = -1);
  /// Kills the process group if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The read end of its stdout, for poll(); owned by this object.
  int output() const { return output_; }
  /// The complete lines that have arrived since the last call, without line breaks; never blocks.
  std::vector<std::string> read_lines();
  /// Whether the process has ended; wait() is still required to reap it.
  bool has_ended() const;
  /// Blocks until the process has ended, kills the remaining processes of its group and reaps it.
  ExitStatus wait();
  /// Sends a signal to the process and its children.
  void signal_group(int signal) const;

 private:
  pid_t pid_ = -1;
  int output_ = -1;
  std::string pending_;  ///< an incomplete line
};

}  // namespace throng::jobs
