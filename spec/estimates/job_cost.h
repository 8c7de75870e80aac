// Time, disk and memory of a job, estimated from the job alone, for `throng check` and
// dry runs.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "spec/job/job_spec.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Estimates; the time is that of the reference machine, a processor like that of
/// docs/rendering.md.
struct JobCost {
  int runs = 0;
  std::int64_t shards = 0;
  std::int64_t images = 0;      ///< total over all runs and cameras
  double cpu_s = 0;             ///< processor time with the software renderer
  std::int64_t disk_bytes = 0;  ///< the dataset and the traces beside it
  std::int64_t memory_mib = 0;  ///< memory of the largest task
};

/// Knowledge of a run before it is simulated.
struct ExpectedRun {
  std::int64_t people = 0;  ///< all people, including those who arrive later
  double at_a_time = 0;     ///< mean number of people who are present at a time
  /// Number of people in an image of each drone's camera; nothing if the drone's path depends on
  /// the people.
  std::vector<std::optional<double>> in_view;
  double ground_m2 = 0;    ///< area of the scenario's ground
  double taking_part = 0;  ///< people who are there at the start or come before the end
  bool is_fled = false;    ///< people flee from a hazard: their positions compress less well
};

/// Estimates the cost as if all people were present all the time and half of them in view. `load`
/// is ResolvedJob::load().
JobCost estimate_cost(const JobSpec& job, SceneLoad load);
/// Estimates the cost from `expected`, which has one element per run, and SceneLoad::models_mib.
JobCost estimate_cost(const JobSpec& job, const std::vector<ExpectedRun>& expected,
                      std::int64_t models_mib);

/// CPU time as answers have it, in tenths of a second.
double rounded_cpu_s(double cpu_s);

/// The members that are estimates, as {"cpu_s", "disk_bytes", "memory_mib", "basis"}; the time is
/// that of the reference machine. The other members are exact, so answers state them separately.
nlohmann::json estimate_json(const JobCost& cost);

/// A warning as answers have it: {"pointer", "found", "expected", "message"}.
nlohmann::json warning_json(const Problem& warning);

/// A size for people: "2.7 MB", "74 GB".
std::string size_text(double bytes);

/// The problem with a job that is estimated to need more than the `disk_bytes` of a disk, which the
/// message describes by `disk`: "of the service's disk".
Problem too_large_for_disk(double planned_bytes, double disk_bytes, std::string_view disk);

/// Adds a warning to the answer of a dry run whose job needs more than what is free on a disk,
/// which the message calls `disk`.
void warn_of_full_disk(nlohmann::json& answer, double free_bytes, std::string_view disk);

}  // namespace throng::jobs
