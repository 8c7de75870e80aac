#include "jobs/pipeline/confined_work.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/unpack.h"
#include "base/graphics/drawing/drawing.h"
#include "jobs/pipeline/checks/catalog.h"
#include "jobs/pipeline/checks/job_check.h"
#include "jobs/pipeline/checks/resolve.h"
#include "jobs/pipeline/checks/scenario_check.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/run_input.h"
#include "places/scenarios/blueprint/blueprint.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "places/scenarios/plan/plan.h"
#include "sim/planning/planned_paths.h"
#include "spec/job/scenario_mix.h"
#include "spec/layouts/plan_sheet.h"
#include "spec/scenarios/scenario_summary.h"
#include "world/scenario.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

std::string text_at(const json& request, const char* key) {
  return request.at(key).get<std::string>();
}

json check_bundle(const json& request) { return check_scenarios(text_at(request, "folder")); }

json unpack_bundle(const json& request) {
  const std::string bytes = read_file(text_at(request, "bundle"));
  unpack_archive(bytes, text_at(request, "unpacked"), request.at("limits").get<UnpackLimits>());
  return json::object();
}

json resolve_document(const json& request) {
  const ResolvedJob job = resolve_valid_job(request.at("job"), "", text_at(request, "scenarios"));
  return {{"job", to_json(job.spec())}, {"load", job.load()}};
}

json dry_run(const json& request) {
  return to_json(check_job(request.at("job"), "", text_at(request, "scenarios")));
}

json draw_scenario(const json& request) {
  const world::Scenario scenario =
      scenarios::find_scenario(text_at(request, "scenarios"), text_at(request, "id"));
  return {{"svg", drawing::to_svg(scenarios::draw_plan(scenario, layouts::kPlanPx))}};
}

json draw_job(const json& request) {
  const JobSpec job = in_scenario_of_run(read_resolved_job(text_at(request, "job"), "").spec(), 0);
  const world::Scenario scenario = load_job_scenario(job, text_at(request, "scenarios"));
  const auto paths = sim::planned_paths(scenario, run_spec(job, 0));
  return {{"svg", drawing::to_svg(scenarios::draw_plan(scenario, layouts::kPlanPx, paths))}};
}

json describe_scenarios(const json& request) {
  json summaries = json::array();
  for (const std::string& id : request.at("ids").get<std::vector<std::string>>()) {
    try {
      summaries.push_back(
          scenario_summary(scenarios::find_scenario(text_at(request, "scenarios"), id)));
    } catch (const InputError& error) {
      // One that is damaged hides no other.
      summaries.push_back({{"error", error.what()}});
    }
  }
  return {{"summaries", std::move(summaries)}};
}

json read_blueprint(const json& request) {
  const std::string name = text_at(request, "id") + std::string(world::kBlueprintEnding);
  const std::filesystem::path file = std::filesystem::path(text_at(request, "scenarios")) / name;
  return {{"blueprint",
           std::filesystem::exists(file) ? scenarios::load_blueprint(file) : json(nullptr)}};
}

using Work = std::pair<const char*, json (*)(const json&)>;
constexpr std::array kWork = {
    Work{"unpack", &unpack_bundle},
    Work{"scenarios", &check_bundle},
    Work{"job", &resolve_document},
    Work{"dry_run", &dry_run},
    Work{"scenario_plan", &draw_scenario},
    Work{"job_plan", &draw_job},
    Work{"summaries", &describe_scenarios},
    Work{"blueprint", &read_blueprint},
    Work{"catalog", [](const json&) { return catalog(); }},
    Work{"people", [](const json&) { return people_catalog(); }},
};

}  // namespace

json do_confined_work(const json& request, const ConfinedWork& others) {
  const std::string task = text_at(request, "task");
  if (const auto other = others.find(task); other != others.end()) return other->second(request);
  const auto* found = std::find_if(kWork.begin(), kWork.end(),
                                   [&](const Work& work) { return task == work.first; });
  if (found == kWork.end()) {
    throw EnvironmentError("this program does not have the work \"" + task +
                           "\" (scripts/setup.sh builds the one that has all)");
  }
  return found->second(request);
}

}  // namespace throng::jobs
