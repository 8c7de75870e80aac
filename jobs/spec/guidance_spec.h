// What a job says of a drone's guidance: the policy and its parameters.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "sim/run.h"

namespace throng::jobs {

/// Reads drones[].guidance, which the schema has accepted. `pointer` is its own. `source` is the
/// job's file, beside which a pilot log lies ("" for a request body, which has no files); what is
/// wrong with a log goes to `problems`.
void read_guidance(const nlohmann::json& value, const std::string& source,
                   const std::string& pointer, sim::DroneMission& mission,
                   std::vector<Problem>& problems);

/// With every default filled in; a pilot log is written out as set-points.
nlohmann::json guidance_json(const sim::DroneMission& mission);

}  // namespace throng::jobs
