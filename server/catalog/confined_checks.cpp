#include "server/catalog/confined_checks.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "spec/estimates/task_memory.h"
#include "spec/job/spec.h"

namespace throng::server {

namespace fs = std::filesystem;
using nlohmann::json;

ConfinedChecks::ConfinedChecks(jobs::ConfinedTask task, const fs::path& data,
                               std::int64_t max_task_mib)
    : task_(std::move(task)), data_(fs::absolute(data)), max_task_mib_(max_task_mib) {
  check(task_ != nullptr, "the service knows how to start its checks");
}

json ConfinedChecks::answer_to(const json& request) const {
  const StagingFolder work(data_ / "check");
  return answer_in(work.path(), request);
}

json ConfinedChecks::answer_in(const fs::path& work, const json& request) const {
  try {
    return task_(request, work);
  } catch (const EnvironmentError&) {
    const fs::path log = work / "log.txt";
    if (fs::exists(log)) spdlog::error("{}: {}", request.at("task").dump(), read_file(log));
    throw;
  }
}

jobs::CheckedScenarios ConfinedChecks::scenarios(const fs::path& folder) const {
  return answer_to({{"task", "scenarios"}, {"subject", "scenarios"}, {"folder", folder.string()}})
      .get<jobs::CheckedScenarios>();
}

jobs::ResolvedJob ConfinedChecks::job(const json& document, const fs::path& scenarios) const {
  jobs::check_job_schema(document, "");
  json answer = answer_to({{"task", "job"},
                           {"subject", "a job and a scenario"},
                           {"job", document},
                           {"scenarios", scenarios.string()}});
  jobs::ResolvedJob resolved = jobs::resolved_job_from_json(
      std::move(answer.at("job")), "", answer.at("load").get<jobs::SceneLoad>());
  require_memory(jobs::TaskMemory(resolved.spec(), resolved.load()).max_mib(), "/drones");
  return resolved;
}

json ConfinedChecks::dry_run(const json& document, const fs::path& scenarios) const {
  json answer = answer_to({{"task", "dry_run"},
                           {"subject", "a job and a scenario"},
                           {"job", document},
                           {"scenarios", scenarios.string()}});
  require_memory(answer.at("estimate").at("memory_mib").get<std::int64_t>(), "/drones");
  return answer;
}

std::string ConfinedChecks::scenario_plan(const std::string& id, const fs::path& scenarios) const {
  return answer_to({{"task", "scenario_plan"}, {"id", id}, {"scenarios", scenarios.string()}})
      .at("svg");
}

std::string ConfinedChecks::job_plan(const std::string& job_json, const fs::path& scenarios) const {
  return answer_to({{"task", "job_plan"}, {"job", job_json}, {"scenarios", scenarios.string()}})
      .at("svg");
}

std::vector<json> ConfinedChecks::summaries(const std::vector<std::string>& ids,
                                            const fs::path& scenarios) const {
  if (ids.empty()) return {};
  return answer_to({{"task", "summaries"}, {"ids", ids}, {"scenarios", scenarios.string()}})
      .at("summaries");
}

json ConfinedChecks::blueprint(const std::string& id, const fs::path& scenarios) const {
  return answer_to({{"task", "blueprint"}, {"id", id}, {"scenarios", scenarios.string()}})
      .at("blueprint");
}

std::int64_t ConfinedChecks::calibration(const json& request, const fs::path& files) const {
  const json answer =
      answer_to({{"task", "calibration"}, {"request", request}, {"files", files.string()}});
  const std::int64_t mib = jobs::calibration_memory_mib(answer.value("max_image_pixels", 0LL));
  require_memory(mib, "/images");
  return mib;
}

json ConfinedChecks::study(const json& document, const fs::path& scenarios) const {
  json plan = answer_to({{"task", "study"},
                         {"subject", "a study and its scenarios"},
                         {"study", document},
                         {"scenarios", scenarios.string()}});
  require_memory(plan.at("memory_mib").get<std::int64_t>(), "/cases", "simulations");
  return plan;
}

void ConfinedChecks::require_memory(std::int64_t mib, const char* pointer, const char* what) const {
  if (max_task_mib_ == 0 || mib <= max_task_mib_) return;
  throw InputError(
      Problem{"", pointer, fmt::format("{} that need about {} MiB of memory", what, mib),
              fmt::format("smaller ones: this service has {} MiB for a task", max_task_mib_)});
}

const json& ConfinedChecks::catalog() const {
  std::call_once(catalog_once_, [&] { catalog_ = answer_to({{"task", "catalog"}}); });
  return catalog_;
}

Unpacked ConfinedChecks::unpack(std::string_view bytes, const fs::path& folder,
                                const UnpackLimits& limits) const {
  const StagingFolder work(data_ / "check");
  const fs::path bundle = work.path() / "bundle";
  const fs::path unpacked = work.path() / "unpacked";
  write_temporary_file(bundle, bytes);
  fs::create_directory(unpacked);
  answer_in(work.path(), {{"task", "unpack"},
                          {"subject", "a bundle"},
                          {"bundle", bundle.string()},
                          {"unpacked", unpacked.string()},
                          {"limits", limits}});
  return copy_unpacked(unpacked, folder, limits);
}

json ConfinedChecks::people() const { return answer_to({{"task", "people"}}); }

}  // namespace throng::server
