// Checks of what users send, for tests: by the program's own confined children, or, where the
// program is not part of the build, as far as spec knows.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/resources.h"
#include "base/files/unpack.h"
#include "jobs/queue/confine/checked_scenarios.h"
#include "jobs/queue/confine/confined_task.h"
#include "spec/estimates/job_cost.h"
#include "spec/job/resolved_job.h"
#include "spec/job/spec.h"
#include "spec/scenarios/scenario_summary.h"
#include "world/fields/read_scenario.h"
#include "world/scenario.h"

namespace throng::server {

/// $THRONG_TEST_PROGRAM or the program of the same build folder; empty where it is not built.
#ifdef THRONG_HAS_PROGRAM
inline std::string test_program() {
  if (const char* given = std::getenv("THRONG_TEST_PROGRAM")) return given;
  return (program_path().parent_path().parent_path().parent_path() / "cli/throng").string();
}
inline const std::string kProgram = test_program();
#else
inline const std::string kProgram;
#endif

/// Skips a test that needs the program where it is not built (ThreadSanitizer).
#define SKIP_WITHOUT_PROGRAM() \
  if (throng::server::kProgram.empty()) GTEST_SKIP() << "the program is not part of this build"

/// A scenario that is no blueprint.
inline world::Scenario find_scenario(const std::filesystem::path& folder, const std::string& id) {
  return world::load_scenario(world::scenario_file(folder, id), id);
}

/// Resolves a job without its crowd, drones' flights and lenses.
inline nlohmann::json resolve_lightly(const nlohmann::json& request) {
  jobs::JobSpec job = jobs::check_and_read_job(request.at("job"), "");
  if (!job.generate) {
    try {
      const world::Scenario scenario = find_scenario(
          std::filesystem::path(request.at("scenarios").get<std::string>()), job.scenario);
      if (job.drones.empty()) {
        for (const world::DroneStart& drone : scenario.drones) {
          job.drones.emplace_back().mission.id = drone.id;
        }
      }
    } catch (const InputError& error) {
      throw InputError(Problem{"", "/scenario", error.problems().front().found,
                               error.problems().front().expected});
    }
  }
  if (job.crowd.model.empty()) job.crowd.model = "weidmann";
  return {{"job", to_json(job)}, {"load", jobs::SceneLoad{}}};
}

/// A dry run without views and warnings.
inline nlohmann::json dry_run_lightly(const nlohmann::json& request) {
  const nlohmann::json job = resolve_lightly(request).at("job");
  constexpr int kPeople = 2;
  const jobs::JobCost cost = jobs::estimate_cost(jobs::check_and_read_job(job, ""), {kPeople});
  return {{"job", job},
          {"runs", cost.runs},
          {"shards", cost.shards},
          {"frames", cost.images},
          {"people", kPeople},
          {"estimate", jobs::estimate_json(cost)},
          {"views", nlohmann::json::array()},
          {"warnings", nlohmann::json::array()}};
}

inline nlohmann::json check_lightly(const nlohmann::json& request) {
  const std::string task = request.at("task");
  if (task == "job") return resolve_lightly(request);
  if (task == "dry_run") return dry_run_lightly(request);
  if (task == "catalog") {
    return {{"airframes", nlohmann::json::array()},
            {"formats", nlohmann::json::array()},
            {"policies", nlohmann::json::array()}};
  }
  if (task == "unpack") {
    unpack_archive(read_file(request.at("bundle").get<std::string>()),
                   request.at("unpacked").get<std::string>(),
                   request.at("limits").get<UnpackLimits>());
    return nlohmann::json::object();
  }
  if (task == "people") return nullptr;
  if (task == "calibration") return nlohmann::json::object();
  if (task == "summaries") {
    nlohmann::json list = nlohmann::json::array();
    for (const std::string& id : request.at("ids").get<std::vector<std::string>>()) {
      list.push_back(
          jobs::scenario_summary(find_scenario(request.at("scenarios").get<std::string>(), id)));
    }
    return {{"summaries", std::move(list)}};
  }
  if (task != "scenarios") return {{"svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>"}};
  const std::filesystem::path folder = request.at("folder").get<std::string>();
  jobs::CheckedScenarios checked{world::list_scenarios(folder)};
  for (const std::string& id : checked.ids) {
    checked.summaries.push_back(jobs::scenario_summary(find_scenario(folder, id)));
  }
  return checked;
}

/// The program's children.
inline jobs::ConfinedTask real_checks() {
  return jobs::confined_task_by(
      std::make_shared<jobs::ForkServer>(std::vector<std::string>{kProgram, "confined"}));
}

/// The program's children, but for jobs, of which there are many; everything lightly where there is
/// no program.
inline jobs::ConfinedTask test_checks() {
  if (kProgram.empty())
    return [](const auto& request, const auto&) { return check_lightly(request); };
  return [real = real_checks()](const nlohmann::json& request, const std::filesystem::path& work) {
    return request.at("task") == "job" ? check_lightly(request) : real(request, work);
  };
}

}  // namespace throng::server
