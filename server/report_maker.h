// Reports of jobs (throng report), made when somebody first asks for one.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace throng::server {

/// Writes the report of the job in a folder (jobs/queue/folder.h) to a file, which appears when it
/// is complete. Throws EnvironmentError and, once a stop is requested, Cancelled.
using Reporter = std::function<void(const std::filesystem::path& job,
                                    const std::filesystem::path& file, const std::stop_token&)>;

/// In a child: `command` with the folder, "-o" and the file appended.
Reporter reporter_in_child(std::vector<std::string> command);

/// One report after the other, in a thread of its own: reading thousands of frames takes longer
/// than a request may. Safe to use from many threads.
class ReportMaker {
 public:
  explicit ReportMaker(Reporter reporter);

  /// The report's file, which is kept in the job's folder; nothing when it is not there after
  /// `patience`: then it is waited for or being made, ask again. Throws EnvironmentError when
  /// making it has failed; asked again, it is tried again.
  std::optional<std::filesystem::path> report_of(const std::filesystem::path& job,
                                                 std::chrono::milliseconds timeout);

  /// Removes the report of a job whose results change.
  static void forget(const std::filesystem::path& job);

 private:
  void work(const std::stop_token& stop);
  std::string failure_of(const std::filesystem::path& job, const std::stop_token& stop) const;

  Reporter reporter_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::filesystem::path> waiting_;              ///< the first is being made
  std::map<std::filesystem::path, std::string> failures_;  ///< not yet reported
  std::jthread worker_;
};

}  // namespace throng::server
