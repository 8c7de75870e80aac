#include "spec/job/schema.h"

#include <nlohmann/json.hpp>

#include "base/json/field_table.h"
#include "base/schemas/json_schema.h"
#include "spec/job/job_fields.h"
#include "spec/sun/sun_times.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

/// Names the schema that an editor checks a document with; nothing to us.
constexpr const char* kSchemaField = "$schema";

}  // namespace

const json& job_schema() {
  static const json schema = ordered_job_schema();
  return schema;
}

std::string_view job_schema_text() {
  static const std::string text = fields::schema_text(ordered_job_schema());
  return text;
}

std::vector<Problem> schema_problems(const json& job, const std::string& source) {
  static const schemas::JsonSchema schema(job_schema());
  if (!job.is_object()) return schema.problems(job, source);
  json resolved = job;
  resolved.erase(kSchemaField);
  std::vector<Problem> of_times;  // which say more than the schema's pattern
  resolve_sun_times(resolved, of_times);
  std::vector<Problem> problems = schema.problems(resolved, source);
  for (Problem& problem : of_times) {
    std::erase_if(problems, [&](const Problem& other) { return other.where == problem.where; });
    problem.source = source;
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace throng::jobs
