// A job's specification of a drone's guidance: the policy and its parameters.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/job/field_table.h"
#include "spec/job/spec.h"

namespace throng::jobs {

/// The fields of drones[].guidance. A pilot log is named relative to the job's file and is not
/// opened here; a job in a request body cannot name files.
const FieldTable<DroneSpec>& guidance_fields();

/// Reads drones[].guidance, which must be valid by the schema, into `drone`. `pointer` is its JSON
/// pointer, `source` the job's file or "". Adds to `problems`.
void read_guidance(const nlohmann::json& value, const std::string& source,
                   const std::string& pointer, DroneSpec& drone, std::vector<Problem>& problems);

/// drones[].guidance with all defaults filled in. A pilot log that has been read is written as
/// set-points.
nlohmann::json guidance_json(const DroneSpec& drone);

}  // namespace throng::jobs
