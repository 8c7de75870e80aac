// Work of the service's confined child processes (jobs/queue/confine/confined_task.h): everything
// that loads a scenario, or needs the engine.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng::jobs {

/// Carries out a request by its "task":
///   scenarios      checks those in "folder": CheckedScenarios
///   job            resolves the text "job" with the scenarios in "scenarios": {"job": ...}
///   dry_run        checks it likewise and says what it will take
///   (jobs/pipeline/checks/job_check.h) scenario_plan  draws the floor plan of the scenario "id" in
///   "scenarios": {"svg": ...} job_plan       likewise of the resolved job "job", with the paths of
///   its drones: {"svg": ...} summaries      describes the scenarios "ids" in "scenarios":
///   {"summaries": [...]}, each as
///                  scenario_summary() does or with an "error"
///   blueprint      reads the blueprint of the scenario "id" in "scenarios", with what it extends:
///                  {"blueprint": ...}; null if there is none
///   calibration    checks the calibration "request", whose files lie in "files":
///                  {"max_image_pixels": ...}
///   catalog        names that jobs may use (jobs/pipeline/checks/catalog.h)
///   people         the character library, or null
/// or one of `others`, by its name: work of modules above this one. Throws InputError and
/// EnvironmentError.
nlohmann::json do_confined_work(
    const nlohmann::json& request,
    const std::map<std::string, std::function<nlohmann::json(const nlohmann::json&)>>& others = {});

}  // namespace throng::jobs
