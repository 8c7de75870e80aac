// A fork server: a process that has loaded the program and its libraries once, and forks a child
// for every piece of work. A new start of the program takes a hundred times as long as a fork.
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
  /// `command` runs run_fork_server(); it is started with the first piece of work, and again when
  /// it has ended.
  explicit ForkServer(std::vector<std::string> command);
  /// Ends the server and its children.
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

  /// Has a child do the work in a folder, and waits for its end. The child's stderr is
  /// in the folder's log.txt. Throws EnvironmentError when there is no server to be had.
  ExitStatus run(const std::filesystem::path& work);

  /// Ends the server and its children: who waits for one gets an EnvironmentError, now and later.
  void stop();

 private:
  class Connection;

  std::shared_ptr<Connection> connection();

  std::vector<std::string> command_;
  std::mutex mutex_;
  std::shared_ptr<Connection> connection_;  ///< guarded by mutex_; null until it is needed
  bool is_stopped_ = false;                 ///< guarded by mutex_
};

/// The server's side: forks a child that returns `work`'s exit code for each folder that it is
/// sent. A child that takes longer than two minutes is ended by SIGALRM. Returns when its client is
/// gone, or has asked for nothing for some minutes. Call it before any other thread is started.
int run_fork_server(const std::function<int(const std::filesystem::path&)>& work);

}  // namespace throng::jobs
