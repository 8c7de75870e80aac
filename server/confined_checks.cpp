#include "server/confined_checks.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "base/error.h"
#include "base/files.h"
#include "jobs/spec/spec.h"

namespace throng::server {

namespace fs = std::filesystem;
using nlohmann::json;

ConfinedChecks::ConfinedChecks(jobs::ConfinedTask task, const fs::path& data)
    : task_(std::move(task)), data_(fs::absolute(data)) {
  check(task_ != nullptr, "the service knows how to start its checks");
}

json ConfinedChecks::answer_to(const json& request) const {
  const StagingFolder work(data_ / "check");
  try {
    return task_(request, work.path());
  } catch (const EnvironmentError&) {
    const fs::path log = work.path() / "log.txt";
    if (fs::exists(log)) spdlog::error("{}: {}", request.at("task").dump(), read_file(log));
    throw;
  }
}

jobs::CheckedScenarios ConfinedChecks::scenarios(const fs::path& folder) const {
  return answer_to({{"task", "scenarios"}, {"subject", "scenarios"}, {"folder", folder.string()}})
      .get<jobs::CheckedScenarios>();
}

jobs::ResolvedJob ConfinedChecks::job(std::string_view job_json, const fs::path& scenarios) const {
  jobs::check_job_schema(job_json, "");
  const json answer = answer_to({{"task", "job"},
                                 {"subject", "a job and a scenario"},
                                 {"job", job_json},
                                 {"scenarios", scenarios.string()}});
  return jobs::read_resolved_job(answer.at("job").dump(), "");
}

std::string ConfinedChecks::scenario_plan(const std::string& id, const fs::path& scenarios) const {
  return answer_to({{"task", "scenario_plan"}, {"id", id}, {"scenarios", scenarios.string()}})
      .at("svg");
}

std::string ConfinedChecks::job_plan(const std::string& job_json, const fs::path& scenarios) const {
  return answer_to({{"task", "job_plan"}, {"job", job_json}, {"scenarios", scenarios.string()}})
      .at("svg");
}

void ConfinedChecks::calibration(const json& request, const fs::path& files) const {
  answer_to({{"task", "calibration"}, {"request", request}, {"files", files.string()}});
}

const json& ConfinedChecks::catalog() const {
  std::call_once(catalog_once_, [&] { catalog_ = answer_to({{"task", "catalog"}}); });
  return catalog_;
}

json ConfinedChecks::people() const { return answer_to({{"task", "people"}}); }

}  // namespace throng::server
