// Validation of a job against its JSON Schema, the definition of valid jobs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// The JSON Schema of a job.
const nlohmann::json& job_schema();
/// The schema as text, with the fields in the order of docs/reference/job.md.
std::string_view job_schema_text();

/// All violations of the schema: one problem per value, with its JSON pointer, the value found and
/// the value expected. Empty if `job` is valid. `source` names the text in the problems.
std::vector<Problem> schema_problems(const nlohmann::json& job, const std::string& source);

}  // namespace throng::jobs
