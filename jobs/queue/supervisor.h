// Runs all tasks of one job, from its spec to its dataset. `throng run` and the server use it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/workers/executor.h"
#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Stage of a run.
enum class Stage { waiting, simulating, rendering, rendered, publishing, finished, failed };

std::string_view to_string(Stage stage);

/// Rate of rendering and the time left at that rate.
struct RenderRate {
  double images_per_s = 0;            ///< 0 before the first image
  std::optional<double> remaining_s;  ///< none before the first image
};

struct RunProgress {
  int run = 0;
  std::uint64_t seed = 0;
  Stage stage = Stage::waiting;
  double simulated_s = 0;        ///< simulated time so far
  double duration_s = 0;         ///< simulated time at the end: CaptureSpec::end_s()
  std::int64_t images_done = 0;  ///< over all cameras
  std::int64_t images_total = 0;
  RenderRate pace;
};

/// A shard that a worker renders now.
struct ShardProgress {
  Task task;
  std::int64_t images_done = 0;
  std::int64_t images_total = 0;
  RenderRate pace;
  std::string node = {};  ///< the worker's cluster node; "" on this machine
};

/// Progress of the upload of a dataset to an object store.
struct DeliveryProgress {
  std::string address;  ///< s3://...
  std::int64_t bytes_done = 0;
  std::int64_t bytes_total = 0;              ///< 0: not known yet
  std::optional<std::int64_t> objects = {};  ///< number of objects, once all are uploaded
};

/// Progress of a whole job.
struct JobProgress {
  std::vector<RunProgress> runs;
  std::vector<ShardProgress> shards;  ///< shards with reported progress, not yet finished
  std::vector<NodeWork> nodes = {};   ///< cluster nodes sorted by name; empty without a cluster
  RenderRate pace;                    ///< over all runs that have not failed
  std::optional<DeliveryProgress> delivery = {};  ///< from the start of the upload on, if any
};

using OnJobProgress = std::function<void(const JobProgress&)>;

/// A failed run: one of its tasks failed after all attempts.
struct RunFailure {
  int run = 0;
  std::string task;     ///< name of the failed task
  std::string message;  ///< for people; begins with the task's name
  int attempts = 0;     ///< at the failed task
};

/// Runs every task of the job whose output does not exist yet. Safe to repeat after any
/// interruption; the result has the same bytes. Runs that fail are left out of the dataset and
/// returned; another call tries them again. `share` names the job's owner. Calls `on_progress` from
/// the calling thread. Throws InputError for a wrong job, EnvironmentError if all runs failed
/// (names the task and the cause) or another supervisor works in the folder, and Cancelled after a
/// stop.
std::vector<RunFailure> run_job(const JobFolder& folder, const ResolvedJob& job, Executor& executor,
                                const OnJobProgress& on_progress = {}, std::stop_token stop = {},
                                const Share& share = {});

}  // namespace throng::jobs
