// Checks a job against the JSON Schema, which is the one definition of what a job may say.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// The JSON Schema of a job.
const nlohmann::json& job_schema();
/// The same as text, whose fields are in the order of docs/reference/job.md.
std::string_view job_schema_text();

/// Everything in which `job` breaks the schema: one problem per place, with its JSON pointer, what
/// stands there and what should. Empty when it is valid. `source` names the text in the problems.
std::vector<Problem> schema_problems(const nlohmann::json& job, const std::string& source);

}  // namespace throng::jobs
