// Work in confined child processes (jobs/pipeline/confined_work.h): all work that loads a scenario
// or needs the simulation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/unpack.h"
#include "jobs/queue/confine/checked_scenarios.h"
#include "jobs/queue/confine/confined_task.h"
#include "spec/job/resolved_job.h"

namespace throng::server {

/// Safe to use from many threads; each call blocks until its child has ended. All calls throw
/// InputError with every problem, also if the child exceeded a limit, and EnvironmentError.
class ConfinedChecks {
 public:
  /// Temporary folders for the children's files are created in `data`. Jobs, calibrations and
  /// studies with a task that needs more than `max_task_mib` of memory
  /// (spec/estimates/task_memory.h) are refused; 0: no limit.
  ConfinedChecks(jobs::ConfinedTask task, const std::filesystem::path& data,
                 std::int64_t max_task_mib = 0);

  /// Checks the scenarios in a folder.
  jobs::CheckedScenarios scenarios(const std::filesystem::path& folder) const;
  /// Resolves a job with the scenarios in a folder. A job that violates the schema is refused
  /// without a child.
  jobs::ResolvedJob job(const nlohmann::json& document,
                        const std::filesystem::path& scenarios) const;
  /// Checks and estimates of a job before it runs (jobs/pipeline/checks/job_check.h), as JSON.
  /// Violations of the schema are reported with all other mistakes.
  nlohmann::json dry_run(const nlohmann::json& document,
                         const std::filesystem::path& scenarios) const;
  /// Floor plans as SVG: of a scenario, and of a resolved job with its drones' paths.
  std::string scenario_plan(const std::string& id, const std::filesystem::path& scenarios) const;
  std::string job_plan(const std::string& job_json, const std::filesystem::path& scenarios) const;
  /// Summaries of scenarios for clients (spec/scenarios/scenario_summary.h), in the order of the
  /// ids; an object with an "error" for a scenario that cannot be loaded.
  std::vector<nlohmann::json> summaries(const std::vector<std::string>& ids,
                                        const std::filesystem::path& scenarios) const;
  /// The blueprint of a scenario, merged with the ones that it extends; null if there is none.
  nlohmann::json blueprint(const std::string& id, const std::filesystem::path& scenarios) const;
  /// Checks a calibration's request, whose files are in the folder. Returns its need of memory in
  /// MiB.
  std::int64_t calibration(const nlohmann::json& request, const std::filesystem::path& files) const;
  /// Checks a study and returns its plan (jobs/study/service_work.h): cases, policies, number of
  /// simulations, and memory of the largest one.
  nlohmann::json study(const nlohmann::json& document,
                       const std::filesystem::path& scenarios) const;
  /// Names that jobs may use (jobs/pipeline/checks/catalog.h); computed once.
  const nlohmann::json& catalog() const;
  /// The character library (jobs/pipeline/checks/catalog.h), or null.
  nlohmann::json people() const;

  /// unpack_archive() by a child; what it has written is copied by copy_unpacked().
  Unpacked unpack(std::string_view bytes, const std::filesystem::path& folder,
                  const UnpackLimits& limits) const;

 private:
  nlohmann::json answer_to(const nlohmann::json& request) const;
  nlohmann::json answer_in(const std::filesystem::path& work, const nlohmann::json& request) const;
  void require_memory(std::int64_t mib, const char* pointer, const char* what = "images") const;

  jobs::ConfinedTask task_;
  std::filesystem::path data_;
  std::int64_t max_task_mib_;
  mutable std::once_flag catalog_once_;
  mutable nlohmann::json catalog_;
};

}  // namespace throng::server
