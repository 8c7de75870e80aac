#include "spec/job/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/compute/random.h"
#include "base/error.h"
#include "spec/job/render_cost.h"

namespace throng::jobs {

namespace {

constexpr std::int64_t kFramesPerShard = 30;
constexpr std::int64_t kShardsPerShortRun = 4;
/// A worker needs longer than this before its first image: driver, people, place.
constexpr double kMinShardS = 1;

/// The CPU time of a frame of the job as it is written: shards must not depend on what is sampled
/// for a run.
double frame_cpu_s(const JobSpec& job) {
  const double in_view = kShareInView * job.agents.value_or(0);
  double frame_s = 0;
  for (const DroneSpec& drone : job.drones) {
    frame_s += image_cpu_s(job.quality, drone.camera, in_view);
  }
  return frame_s;
}

std::int64_t frames_per_shard(const JobSpec& job, std::int64_t frames) {
  const std::int64_t quarter = (frames + kShardsPerShortRun - 1) / kShardsPerShortRun;
  const double worthwhile = std::ceil(kMinShardS / frame_cpu_s(job));
  const auto least =
      worthwhile < kFramesPerShard ? static_cast<std::int64_t>(worthwhile) : kFramesPerShard;
  return std::clamp(quarter, least, kFramesPerShard);
}

}  // namespace

std::vector<RunPlan> plan_runs(const JobSpec& job) {
  std::vector<RunPlan> runs;
  runs.reserve(static_cast<std::size_t>(job.runs));
  for (int i = 0; i < job.runs; ++i) runs.push_back({i, run_seed(job, i)});
  return runs;
}

std::uint64_t run_seed(const JobSpec& job, int run) {
  return derive_seed(job.seed, Stream::run, static_cast<std::uint64_t>(run));
}

std::vector<Shard> plan_shards(const JobSpec& job, int run) {
  if (job.drones.empty()) return {};
  const std::int64_t frames = job.frames_per_camera();
  const std::int64_t size = frames_per_shard(job, frames);
  std::vector<Shard> shards;
  for (std::int64_t first = 0; first < frames; first += size) {
    shards.push_back({run, static_cast<int>(shards.size()), first, std::min(first + size, frames)});
  }
  return shards;
}

std::int64_t image_id(const JobSpec& job, int run, std::size_t camera, std::int64_t frame) {
  const auto cameras = static_cast<std::int64_t>(job.drones.size());
  return 1 + frame + job.frames_per_camera() * (static_cast<std::int64_t>(camera) + cameras * run);
}

bool has_preview(const JobSpec& job, std::int64_t frame) {
  // The frame in the middle of each of n parts of equal length.
  const std::int64_t frames = job.frames_per_camera();
  const std::int64_t parts = std::min<std::int64_t>(job.outputs.previews, frames);
  for (std::int64_t part = 0; part < parts; ++part) {
    if (frame == (2 * part + 1) * frames / (2 * parts)) return true;
  }
  return false;
}

std::string run_name(int run) { return fmt::format("run{:03}", run); }

std::string to_string(const Task& task) {
  switch (task.kind) {
    case Task::Kind::simulate:
      return run_name(task.run) + "/trace";
    case Task::Kind::measure:
      return run_name(task.run) + "/metrics";
    case Task::Kind::render:
      return fmt::format("{}/shard{:04}", run_name(task.run), task.shard);
    case Task::Kind::publish:
      return kPublishName;
    case Task::Kind::calibrate:
      return "calibration";
    case Task::Kind::report:
      return "report";
    case Task::Kind::study_run:
      return fmt::format("{}/{:06}", kStudyRunName, task.shard);
    case Task::Kind::study_report:
      return "study";
    case Task::Kind::collect:
      break;
  }
  return "dataset";
}

Task task_named(const JobSpec& job, const std::string& name) {
  std::vector<Task> tasks = {{Task::Kind::collect}, {Task::Kind::publish}};
  for (int run = 0; run < job.runs; ++run) {
    if (!name.starts_with(run_name(run) + "/")) continue;
    tasks.push_back({Task::Kind::simulate, run});
    tasks.push_back({Task::Kind::measure, run});
    for (const Shard& shard : plan_shards(job, run)) {
      tasks.push_back({Task::Kind::render, run, shard.index});
    }
  }
  for (const Task& task : tasks) {
    if (to_string(task) == name) return task;
  }
  throw InputError(Problem{"", "task", fmt::format("\"{}\"", name),
                           "a task of the job, for example run000/trace or run000/shard0000"});
}

}  // namespace throng::jobs
