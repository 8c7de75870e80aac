// How a job falls into pieces: runs (one simulation each) and shards (ranges of a run's frames).
// Pure functions of the job; a task's name is the same on every machine and at every attempt.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "spec/job/job_spec.h"

namespace throng::jobs {

/// One simulation of the scenario.
struct RunPlan {
  int index = 0;
  std::uint64_t seed = 0;
};

/// Frames [first_frame, end_frame) of one run, seen by all cameras.
struct Shard {
  int run = 0;
  int index = 0;
  std::int64_t first_frame = 0;
  std::int64_t end_frame = 0;
};

std::vector<RunPlan> plan_runs(const JobSpec& job);

/// The shards of a run: they cover its frames exactly once, in order. At most 30 frames each, so
/// that little is lost with a worker; of a short run four shards, so that it uses several cores, or
/// as many as have a second of work each by estimate (render_cost.h), since each starts a worker.
std::vector<Shard> plan_shards(const JobSpec& job, int run);

/// Unique over the job and independent of shards: images are numbered by run, camera, frame.
std::int64_t image_id(const JobSpec& job, int run, std::size_t camera, std::int64_t frame);

/// Whether a preview is drawn of this frame: JobSpec::outputs.previews of them, evenly spread.
bool has_preview(const JobSpec& job, std::int64_t frame);

/// Unit of work of one worker.
struct Task {
  /// The last ones belong to no job's plan: a calibration's folder, a report of a finished job, and
  /// a study's simulations and report.
  enum class Kind {
    simulate,
    measure,
    render,
    collect,
    publish,
    calibrate,
    report,
    study_run,
    study_report
  };
  Kind kind = Kind::collect;
  int run = 0;    ///< simulate, measure, render
  int shard = 0;  ///< render; study_run: the number of the run (spec/study/study_files.h)
  auto operator<=>(const Task&) const = default;
};

/// "run000/trace", "run000/metrics", "run000/shard0003", "dataset", "publish", "calibration",
/// "report", "simulation/000012", "study": what the task publishes.
std::string to_string(const Task& task);

inline constexpr const char* kPublishName = "publish";
inline constexpr const char* kStudyRunName = "simulation";

/// The reverse, for tasks of the job's plan. Throws InputError when the job has no such task.
Task task_named(const JobSpec& job, const std::string& name);

/// "run000"
std::string run_name(int run);

}  // namespace throng::jobs
