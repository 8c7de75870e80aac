// Reports of jobs (throng report), created at the first request.
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
  int at_once = 2;               ///< number of threads, so that one that hangs blocks no others
  std::size_t max_waiting = 32;  ///< max number of unfinished reports; more are refused
};

/// Creates reports as tasks (jobs/queue/workers/executor.h) in threads of its own, because that
/// takes longer than a request may. Safe to use from many threads.
class ReportMaker {
 public:
  /// The executor must outlive this object.
  explicit ReportMaker(jobs::Executor& executor, ReportMakerOptions options = {});

  /// The report's file in the job's folder, created if needed. std::nullopt if it is not finished
  /// after `timeout`: call again. Throws EnvironmentError if the creation has failed (the next call
  /// tries again) or too many reports wait.
  std::optional<std::filesystem::path> report_of(const std::filesystem::path& job,
                                                 const jobs::Share& share,
                                                 std::chrono::milliseconds timeout);

  /// Removes the report of a job whose results will change.
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
  std::map<std::filesystem::path, std::string> failures_;  ///< failures not reported yet
  std::vector<std::jthread> workers_;
};

}  // namespace throng::server
