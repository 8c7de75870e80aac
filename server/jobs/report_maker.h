// Reports of jobs (throng report), made when somebody first asks for one.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "jobs/queue/workers/executor.h"

namespace throng::server {

struct ReportMakerOptions {
  int at_once = 2;               ///< a report that hangs does not hold back the next
  std::size_t max_waiting = 32;  ///< not yet made; more are refused
};

/// Reports are tasks like those of jobs (jobs/queue/workers/executor.h), made in threads of their
/// own: reading thousands of frames takes longer than a request may. Safe to use from many threads.
class ReportMaker {
 public:
  /// The executor must outlive it.
  explicit ReportMaker(jobs::Executor& executor, ReportMakerOptions options = {});

  /// The report's file, which is kept in the job's folder; nothing when it is not there after
  /// `timeout`: then it is waited for or being made, ask again. Throws EnvironmentError when
  /// making it has failed (asked again, it is tried again), or when too many wait.
  std::optional<std::filesystem::path> report_of(const std::filesystem::path& job,
                                                 const jobs::Share& share,
                                                 std::chrono::milliseconds timeout);

  /// Removes the report of a job whose results change.
  static void forget(const std::filesystem::path& job);

 private:
  struct Order {
    std::filesystem::path job;
    jobs::Share share;
    bool is_begun = false;
  };

  void work(const std::stop_token& stop);
  std::string failure_of(const Order& order, const std::stop_token& stop) const;
  std::deque<Order>::iterator find_order(const std::filesystem::path& job);
  std::deque<Order>::iterator next_order();

  jobs::Executor& executor_;
  ReportMakerOptions options_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Order> orders_;
  std::map<std::filesystem::path, std::string> failures_;  ///< not yet reported
  std::vector<std::jthread> workers_;
};

}  // namespace throng::server
