// Requests that the service performs in confined child processes
// (jobs/queue/confine/confined_task.h): all work that loads a scenario or needs the simulation.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng::jobs {

/// Work of modules above this one, by the task that a request names: gives the answer.
using ConfinedWork = std::map<std::string, std::function<nlohmann::json(const nlohmann::json&)>>;

/// Performs a request according to its member "task". "scenarios" and "files" are paths of folders.
///   unpack         unpacks the file "bundle" into the folder "unpacked" within "limits"
///   scenarios      checks the scenarios in "folder": CheckedScenarios
///   job            resolves "job", which obeys the schema, with "scenarios": {"job", "load"}
///   dry_run        checks "job" with "scenarios" (checks/job_check.h)
///   scenario_plan  draws the floor plan of the scenario "id" in "scenarios": {"svg"}
///   job_plan       draws that of the resolved job "job", with its drones' paths: {"svg"}
///   summaries      describes the scenarios "ids" in "scenarios": {"summaries": [...]}, each
///                  the result of scenario_summary() or an "error"
///   blueprint      reads the blueprint of the scenario "id" in "scenarios", merged with the ones
///                  that it extends: {"blueprint"}; null if there is none
///   catalog        returns catalog() (checks/catalog.h)
///   people         returns people_catalog() (checks/catalog.h)
/// Other names are looked up in `others`; a name that is not there, either, is an EnvironmentError:
/// this program does not have that work. Throws InputError and EnvironmentError.
nlohmann::json do_confined_work(const nlohmann::json& request, const ConfinedWork& others = {});

}  // namespace throng::jobs
