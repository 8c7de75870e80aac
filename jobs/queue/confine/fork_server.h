// A fork server: a process that has loaded the program and its libraries once and forks a child
// for each request, because a start of the program takes a hundred times as long as a fork.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "jobs/queue/confine/child_process.h"

namespace throng::jobs {

/// The client's side. Safe to use from many threads.
class ForkServer {
 public:
  /// `command` is a program that calls run_fork_server(). It is started at the first call of run(),
  /// and again if it has ended.
  explicit ForkServer(std::vector<std::string> command);
  /// Ends the server and its children.
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

  /// Forks a child that works in the folder `work`, and blocks until it has ended. The child's
  /// stderr is appended to work/log.txt. Throws EnvironmentError if the server cannot be started.
  ExitStatus run(const std::filesystem::path& work);

  /// Ends the server and its children. All waiting and later calls of run() throw EnvironmentError.
  void stop();

 private:
  class Connection;

  std::shared_ptr<Connection> connection();

  std::vector<std::string> command_;
  std::mutex mutex_;
  std::shared_ptr<Connection> connection_;  ///< guarded by mutex_; null until it is needed
  bool is_stopped_ = false;                 ///< guarded by mutex_
};

/// The server's side: for each folder received on stdin, a socket, forks a child that calls `work`
/// and exits with its result. SIGALRM ends a child after two minutes. Returns an exit code once the
/// client is gone or has sent nothing for five minutes while no child ran. Call it before any other
/// thread is started.
int run_fork_server(const std::function<int(const std::filesystem::path&)>& work);

}  // namespace throng::jobs
