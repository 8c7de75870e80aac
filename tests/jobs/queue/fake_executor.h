// An executor that pretends: it publishes what tasks would publish, in this process.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "base/files/files.h"
#include "base/files/hash.h"
#include "jobs/queue/dataset/manifest.h"
#include "jobs/queue/delivery.h"
#include "jobs/queue/trace_seal.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

class FakeExecutor : public Executor {
 public:
  /// Asked before each task; anything but success is its result.
  std::function<TaskResult(const Task&)> before = [](const Task&) { return TaskResult{}; };

  /// Likewise, with the job's folder.
  std::function<TaskResult(const JobFolder&, const Task&)> before_in =
      [](const JobFolder&, const Task&) { return TaskResult{}; };

  /// Does calibrations, reports and studies, which this executor cannot.
  std::function<TaskResult(const JobFolder&, const Task&, const OnProgress&, std::stop_token)>
      other = [](const auto&...) {
        return TaskResult{Outcome::environment_error, 1, "not done here", {}};
      };

  using Executor::run;
  std::vector<TaskResult> run(const JobFolder& folder, std::span<const Task> tasks,
                              const OnProgress& on_progress, std::stop_token stop,
                              const Share& /*share*/) override {
    const std::stop_callback note(stop, [this] { was_stopped_ = true; });
    std::vector<TaskResult> results(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (is_other(tasks[i].kind)) {
        results[i] = other(folder, tasks[i], on_progress, stop);
        continue;
      }
      results[i] =
          stop.stop_requested() ? TaskResult{Outcome::cancelled, 1, "", {}} : before(tasks[i]);
      if (results[i].outcome == Outcome::succeeded) results[i] = before_in(folder, tasks[i]);
      if (results[i].outcome != Outcome::succeeded) continue;
      const std::lock_guard lock(mutex_);
      done_.push_back(to_string(tasks[i]));
      if (on_progress) on_progress(tasks[i], {1, 2});
      publish(folder, tasks[i]);
    }
    return results;
  }

  /// Whether a stop was requested while it was at work.
  bool was_stopped() const { return was_stopped_; }

  std::vector<std::string> done() const {
    const std::lock_guard lock(mutex_);
    return done_;
  }

 private:
  static bool is_other(Task::Kind kind) {
    return kind == Task::Kind::calibrate || kind == Task::Kind::report ||
           kind == Task::Kind::study_run || kind == Task::Kind::study_report;
  }

  static void publish(const JobFolder& folder, const Task& task) {
    const std::filesystem::path output = folder.output_of(task);
    if (task.kind == Task::Kind::simulate) {
      write_file_atomically(output, "trace");
      return seal_trace(output);
    }
    if (task.kind == Task::Kind::publish) return write_delivery(folder, {"s3://data/set", 2, 20});
    StagingFolder staging(output);
    write_file_atomically(staging.path() / "made.json", "{}");
    write_file_atomically(
        staging.path() / "record.json",
        R"({"files": [], "metrics": {"people": 2}, "images": 1, "annotations": 2})");
    if (task.kind == Task::Kind::collect) {
      const std::string metrics = R"({"runs":[]})";
      write_file_atomically(staging.path() / "metrics.json", metrics);
      const std::vector<FileEntry> files = {
          {"metrics.json", static_cast<std::int64_t>(metrics.size()), sha256_hex(metrics)}};
      write_file_atomically(staging.path() / kManifestName,
                            nlohmann::json{{"files", files}}.dump());
    }
    staging.commit();
  }

  std::atomic<bool> was_stopped_ = false;
  mutable std::mutex mutex_;
  std::vector<std::string> done_;
};

}  // namespace throng::jobs
