// The division of a job into runs (one simulation each) and shards (ranges of a run's frames). All
// functions are pure functions of the job, so that a task has the same name on every machine and at
// every attempt.
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

/// Frames [first_frame, end_frame) of one run, of all cameras.
struct Shard {
  int run = 0;
  int index = 0;
  std::int64_t first_frame = 0;
  std::int64_t end_frame = 0;
};

std::vector<RunPlan> plan_runs(const JobSpec& job);

/// Seed of a run, which determines all that is random in it.
std::uint64_t run_seed(const JobSpec& job, int run);

/// The shards of a run, which cover its frames exactly once, in order. A shard has at most 30
/// frames, so that a failed worker loses little. A short run has four shards, so that it uses
/// several cores, or fewer, so that each has an estimated second of work (render_cost.h) for its
/// worker.
std::vector<Shard> plan_shards(const JobSpec& job, int run);

/// Id of an image, unique within the job and independent of shards: images are numbered by run,
/// camera and frame.
std::int64_t image_id(const JobSpec& job, int run, std::size_t camera, std::int64_t frame);

/// Whether this frame has a preview: JobSpec::outputs.previews frames do, evenly spaced.
bool has_preview(const JobSpec& job, std::int64_t frame);

/// The unit of work of one worker process.
struct Task {
  /// The last four are not part of a job's plan: a calibration, a report on a finished job, and a
  /// study's simulations and report.
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

/// Name of a task, which names its result: "run000/trace", "run000/metrics", "run000/shard0003",
/// "dataset", "publish", "calibration", "report", "simulation/000012" or "study".
std::string to_string(const Task& task);

inline constexpr const char* kPublishName = "publish";
inline constexpr const char* kStudyRunName = "simulation";

/// The inverse of to_string() for tasks of the job's plan. Throws InputError if the job has no such
/// task.
Task task_named(const JobSpec& job, const std::string& name);

/// Name of a run: "run000".
std::string run_name(int run);

}  // namespace throng::jobs
