// What a job says of a drone's guidance: the policy and its parameters.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "sim/spec/run_spec.h"

namespace throng::jobs {

/// Reads drones[].guidance, which the schema has accepted. `pointer` is its own. Returns the pilot
/// log that it names, a file beside `source`, the job's file, or ""; a request body (`source` "")
/// has no files. The log is not opened.
std::filesystem::path read_guidance(const nlohmann::json& value, const std::string& source,
                                    const std::string& pointer, sim::DroneMission& mission,
                                    std::vector<Problem>& problems);

/// With every default filled in; a pilot log is written out as set-points.
nlohmann::json guidance_json(const sim::DroneMission& mission);

}  // namespace throng::jobs
