// Brings one job from its spec to its dataset. Used by `throng run` and by the server.
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

/// Progress of a run.
enum class Stage { waiting, simulating, rendering, rendered, publishing, finished, failed };

std::string_view to_string(Stage stage);

/// How fast images are made, and how long what is left takes at that rate. Nothing is known before
/// the first image.
struct Pace {
  double images_per_s = 0;
  std::optional<double> remaining_s;
};

struct RunProgress {
  int run = 0;
  std::uint64_t seed = 0;
  Stage stage = Stage::waiting;
  double simulated_s = 0;  ///< of CaptureSpec::to_s
  double duration_s = 0;
  std::int64_t images_done = 0;  ///< over all cameras
  std::int64_t images_total = 0;
  Pace pace;
};

/// A shard that somebody works on.
struct ShardProgress {
  Task task;
  std::int64_t images_done = 0;
  std::int64_t images_total = 0;
  Pace pace;
  std::string node = {};  ///< of a cluster; "" on this machine
};

/// The way of a job's dataset to an object store.
struct DeliveryProgress {
  std::string address;  ///< s3://...
  std::int64_t bytes_done = 0;
  std::int64_t bytes_total = 0;              ///< 0: not known yet
  std::optional<std::int64_t> objects = {};  ///< once all are there
};

struct JobProgress {
  std::vector<RunProgress> runs;
  std::vector<ShardProgress> shards;  ///< begun and not at their end
  std::vector<NodeWork> nodes = {};   ///< of a cluster, by name
  Pace pace;
  std::optional<DeliveryProgress> delivery = {};  ///< of a job that asks for it, from its begin on
};

using OnJobProgress = std::function<void(const JobProgress&)>;

/// A run that came to no end: one of its tasks failed for good.
struct RunFailure {
  int run = 0;
  std::string task;
  std::string message;
  int attempts = 0;
};

/// Does every task of the job whose output is not there yet. Safe to repeat after any interruption;
/// the result has the same bytes. Runs that fail are left out of the dataset and returned; a
/// repetition tries them again. `share` says whose job it is. No other supervisor may be at work in
/// the folder. Throws InputError, EnvironmentError (no run came to its end: says which task and
/// why), Cancelled.
std::vector<RunFailure> run_job(const JobFolder& folder, const ResolvedJob& job, Executor& executor,
                                const OnJobProgress& on_progress = {}, std::stop_token stop = {},
                                const Share& share = {});

}  // namespace throng::jobs
