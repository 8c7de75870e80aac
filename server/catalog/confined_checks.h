// Work outside the service's own process: everything that loads a scenario or needs the engine runs
// in a confined child (jobs/pipeline/confined_work.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/confine/checked_scenarios.h"
#include "jobs/queue/confine/confined_task.h"
#include "spec/job/resolved_job.h"

namespace throng::server {

/// Safe to use from many threads; each call waits for its child. All throw InputError with every
/// problem, also when the child was ended at a limit, and EnvironmentError.
class ConfinedChecks {
 public:
  /// Folders for the children's files are made in `data`, and removed. Jobs, calibrations and
  /// studies with a task that needs more than `max_task_mib` of memory
  /// (spec/estimates/task_memory.h) are refused; 0: none are.
  ConfinedChecks(jobs::ConfinedTask task, const std::filesystem::path& data,
                 std::int64_t max_task_mib = 0);

  /// The scenarios in a folder.
  jobs::CheckedScenarios scenarios(const std::filesystem::path& folder) const;
  /// The job, resolved with the scenarios in a folder. Violations of the schema are refused before
  /// a child is started.
  jobs::ResolvedJob job(std::string_view job_json, const std::filesystem::path& scenarios) const;
  /// Checks and estimates of a job before it runs (jobs/pipeline/checks/job_check.h), as JSON.
  /// Violations of the schema are reported with all other mistakes.
  nlohmann::json dry_run(std::string_view job_json, const std::filesystem::path& scenarios) const;
  /// Floor plans as SVG: of a scenario, and of a resolved job with the paths of its drones.
  std::string scenario_plan(const std::string& id, const std::filesystem::path& scenarios) const;
  std::string job_plan(const std::string& job_json, const std::filesystem::path& scenarios) const;
  /// Scenarios as clients see them (spec/scenarios/scenario_summary.h), in the order of the ids; of
  /// one that cannot be loaded an object with an "error".
  std::vector<nlohmann::json> summaries(const std::vector<std::string>& ids,
                                        const std::filesystem::path& scenarios) const;
  /// The blueprint that a scenario was made from, with what it extends; null: there is none.
  nlohmann::json blueprint(const std::string& id, const std::filesystem::path& scenarios) const;
  /// A calibration's request, whose files lie in the folder. Returns the memory it needs, in MiB.
  std::int64_t calibration(const nlohmann::json& request, const std::filesystem::path& files) const;
  /// The plan of a study (jobs/study/service_work.h): its cases, policies and number of
  /// simulations, and the memory that the largest needs.
  nlohmann::json study(const nlohmann::json& document,
                       const std::filesystem::path& scenarios) const;
  /// Names that jobs may use (jobs/pipeline/checks/catalog.h); queried once.
  const nlohmann::json& catalog() const;
  nlohmann::json people() const;

 private:
  nlohmann::json answer_to(const nlohmann::json& request) const;
  void require_memory(std::int64_t mib, const char* pointer, const char* what = "images") const;

  jobs::ConfinedTask task_;
  std::filesystem::path data_;
  std::int64_t max_task_mib_;
  mutable std::once_flag catalog_once_;
  mutable nlohmann::json catalog_;
};

}  // namespace throng::server
