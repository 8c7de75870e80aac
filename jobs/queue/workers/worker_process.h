// The process of a task or of a live flight: started by a supervisor, confined, and heard by it
// through stdout.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/workers/worker_messages.h"

namespace throng::jobs {

/// Everything that a worker may use besides reading files.
struct WorkerRights {
  std::filesystem::path folder;  ///< of its job, the only one in which it writes
  /// Folders besides it that messages do not name.
  std::vector<std::filesystem::path> unnamed = {};
  /// Compiled shaders are kept in Mesa's folder: without them each process begins with seconds of
  /// compiling.
  bool keeps_shaders = false;
  /// Network and the credentials of object stores, which come by stdin.
  bool publishes = false;
};

/// This process: one object, which exists until it ends. Safe to use from many threads.
class WorkerProcess {
 public:
  /// From now on the process ends with its supervisor ($THRONG_SUPERVISOR_PID), is confined by
  /// limit_this_process() and fence_this_process(), logs to stderr, and has stdout for send() only:
  /// output of drivers goes to stderr, too.
  explicit WorkerProcess(const WorkerRights& rights);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// Sends a message to the supervisor.
  void send(std::string_view message);
  /// Waits until messages that go to a file have arrived, so that other machines see them.
  void sync() const;

  /// Does the work and returns the exit code (worker_protocol.h). A failure is logged and sent as
  /// `format` writes it: as InputError "input", as EnvironmentError or another lack of the machine
  /// "environment", else "bug".
  int run(const std::function<void()>& work,
          const std::function<std::string(const WorkerError&)>& format);

 private:
  std::vector<std::filesystem::path> folders_;  ///< not to be named in messages
  int output_;
  std::mutex mutex_;  ///< of sending
};

}  // namespace throng::jobs
