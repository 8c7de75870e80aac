#include "jobs/spec/schema.h"

#include <nlohmann/json.hpp>

#include "base/field_table.h"
#include "base/json_schema.h"
#include "jobs/spec/job_fields.h"

namespace throng::jobs {

using nlohmann::json;

const json& job_schema() {
  static const json schema = ordered_job_schema();
  return schema;
}

std::string_view job_schema_text() {
  static const std::string text = fields::schema_text(ordered_job_schema());
  return text;
}

std::vector<Problem> schema_problems(const json& job, const std::string& source) {
  static const JsonSchema schema(job_schema());
  return schema.problems(job, source);
}

}  // namespace throng::jobs
