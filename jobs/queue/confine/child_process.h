// One child process whose stdout we read, in a process group of its own.
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
  int signal = 0;  ///< 0: none
};

/// This process's variables that reach object stores, for the one child that uses them.
std::vector<std::pair<std::string, std::string>> credential_variables();

class ChildProcess {
 public:
  using Variables = std::vector<std::pair<std::string, std::string>>;

  /// Starts command[0] (searched in PATH) with this process's environment changed by `variables`.
  /// Credentials of object stores ($AWS_...) are not handed on, unless they are among `variables`;
  /// the files that hold them are named in $THRONG_PRIVATE_CREDENTIALS
  /// (jobs/queue/confine/file_fence.h). stderr is appended to the file `log`; stdin is the
  /// descriptor `input`, or empty. Throws EnvironmentError.
  ChildProcess(const std::vector<std::string>& command, const Variables& variables,
               const std::filesystem::path& log, int input = -1);
  /// Kills what still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The read end of its stdout, to poll.
  int output() const { return output_; }
  /// The whole lines that have arrived; never blocks.
  std::vector<std::string> read_lines();
  /// Whether the process has ended; it stays to be collected by wait().
  bool has_ended() const;
  /// Kills what the process left behind in its group and collects it. Blocks until it has ended.
  ExitStatus wait();
  /// Sends a signal to the process and its children.
  void signal_group(int signal) const;

 private:
  pid_t pid_ = -1;
  int output_ = -1;
  std::string pending_;  ///< a line that has not ended yet
};

}  // namespace throng::jobs
