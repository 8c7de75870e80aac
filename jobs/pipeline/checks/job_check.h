// Everything that can be said of a job before it runs: every mistake, what it will take, and what
// will succeed but is probably not meant.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "jobs/pipeline/checks/view_check.h"
#include "spec/estimates/job_cost.h"
#include "spec/job/resolved_job.h"

namespace throng::jobs {

struct CheckedJob {
  ResolvedJob job;
  /// Number of people who take part in a run, arrivals included; the mean of the job's scenarios.
  std::int64_t people = 0;
  JobCost cost = {};
  std::vector<CameraView> views = {};  ///< of the first run's cameras with a known path
  std::vector<Problem> warnings = {};  ///< JSON pointers into the job
};

/// Resolves a job's text like resolve_job(), loads its crowd and follows its drones' planned paths;
/// simulates and renders nothing. Throws InputError with all mistakes, EnvironmentError.
CheckedJob check_job(std::string_view json, const std::string& source,
                     const std::filesystem::path& scenarios);

/// {"runs", "shards", "frames", "people", "estimate", "views", "warnings", "job"}: the answer of
/// dry runs.
nlohmann::json to_json(const CheckedJob& checked);

}  // namespace throng::jobs
