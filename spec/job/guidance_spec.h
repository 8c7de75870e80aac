// A job's specification of a drone's guidance: the policy and its parameters.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/job/field_table.h"
#include "spec/job/spec.h"

namespace throng::jobs {

/// The fields of drones[].guidance. A pilot log is a file beside the job's file and is not opened;
/// a request body has no files.
const FieldTable<DroneSpec>& guidance_fields();

/// Reads drones[].guidance, which the schema has accepted. `pointer` is its own, `source` the job's
/// file or "".
void read_guidance(const nlohmann::json& value, const std::string& source,
                   const std::string& pointer, DroneSpec& drone, std::vector<Problem>& problems);

/// With every default filled in; a pilot log is written out as set-points once it has been read.
nlohmann::json guidance_json(const DroneSpec& drone);

}  // namespace throng::jobs
