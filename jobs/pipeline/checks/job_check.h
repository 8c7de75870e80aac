// Dry run: all that can be checked of a job before it runs, namely its mistakes, its cost, and
// settings that are valid but probably not intended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/pipeline/checks/view_check.h"
#include "spec/estimates/job_cost.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

/// Result of check_job().
struct CheckedJob {
  ResolvedJob job;
  /// Number of people in a run, arrivals included; the mean over the job's scenarios.
  std::int64_t people = 0;
  JobCost cost = {};
  std::vector<CameraView> views = {};  ///< of the first run's cameras whose paths are known
  std::vector<Problem> warnings = {};  ///< JSON pointers into the job
};

/// Resolves a job as resolve_job() does, looks at its crowd and evaluates its drones' planned
/// paths; renders nothing. `source` names the document in messages, `scenarios` is the folder of
/// scenarios. Throws InputError with all mistakes, and EnvironmentError.
CheckedJob check_job(const nlohmann::json& document, const std::string& source,
                     const std::filesystem::path& scenarios);

/// The answer to a dry run: {"runs", "shards", "frames", "people", "estimate", "views", "warnings",
/// "job"}.
nlohmann::json to_json(const CheckedJob& checked);

}  // namespace throng::jobs
