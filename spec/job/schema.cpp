#include "spec/job/schema.h"

#include <nlohmann/json.hpp>

#include "base/json/field_table.h"
#include "base/schemas/json_schema.h"
#include "spec/job/job_fields.h"

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
  if (!job.is_object() || !job.contains(kSchemaField)) return schema.problems(job, source);
  json without = job;
  without.erase(kSchemaField);
  return schema.problems(without, source);
}

}  // namespace throng::jobs
