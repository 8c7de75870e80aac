#include "jobs/spec/schema.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/field_table.h"
#include "base/json_describe.h"
#include "base/suggest.h"
#include "jobs/spec/job_fields.h"

namespace throng::jobs {

using fields::expectation;
using nlohmann::json;

namespace {

struct CompiledSchema {
  CompiledSchema() {
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(job_schema()),
                                            schema);
  }
  valijson::Schema schema;
};

// valijson names a place ["<root>", "[drones]", "[0]"].
json::json_pointer pointer_to(const std::vector<std::string>& context) {
  json::json_pointer pointer;
  for (std::size_t i = 1; i < context.size(); ++i) {
    pointer /= context[i].substr(1, context[i].size() - 2);
  }
  return pointer;
}

// The part of the schema that describes the place; our schema nests plainly, without references.
const json& schema_at(const std::vector<std::string>& context) {
  const json* node = &job_schema();
  for (std::size_t i = 1; i < context.size(); ++i) {
    const std::string key = context[i].substr(1, context[i].size() - 2);
    node = node->at("type") == "array" ? &node->at("items") : &node->at("properties").at(key);
  }
  return *node;
}

void add_field_problems(const json& object, const json& schema, const json::json_pointer& place,
                        const std::string& source, std::vector<Problem>& problems) {
  std::vector<std::string_view> known;
  for (const auto& field : schema["properties"].items()) {
    if (!field.value().value("deprecated", false)) known.emplace_back(field.key());
  }
  for (const auto& field : object.items()) {
    if (schema["properties"].contains(field.key())) continue;
    problems.push_back(
        unknown_name(source, (place / field.key()).to_string(), "field", field.key(), known));
  }
  for (const json& field : schema.value("required", json::array())) {
    const auto& name = field.get_ref<const std::string&>();
    if (object.contains(name)) continue;
    problems.push_back(
        {source, (place / name).to_string(), "nothing", expectation(schema["properties"][name])});
  }
}

}  // namespace

const json& job_schema() {
  static const json schema = ordered_job_schema();
  return schema;
}

std::string_view job_schema_text() {
  static const std::string text = schema_text(ordered_job_schema());
  return text;
}

std::vector<Problem> schema_problems(const json& job, const std::string& source) {
  static const CompiledSchema compiled;
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(compiled.schema, valijson::adapters::NlohmannJsonAdapter(job), &results))
    return {};

  // valijson reports a bad value again at every object and array around it. Keep the innermost
  // places, and the objects that have unknown or missing fields themselves.
  std::map<std::vector<std::string>, bool> is_innermost;
  for (const auto& error : results) is_innermost[error.context] = true;
  for (auto& [context, innermost] : is_innermost) {
    const auto next = is_innermost.upper_bound(context);
    innermost = next == is_innermost.end() || next->first.size() <= context.size() ||
                !std::equal(context.begin(), context.end(), next->first.begin());
  }
  std::vector<Problem> problems;
  for (const auto& [context, innermost] : is_innermost) {
    const json::json_pointer place = pointer_to(context);
    const json& value = job.at(place);
    const json& rules = schema_at(context);
    const std::size_t before = problems.size();
    if (value.is_object() && rules["type"] == "object") {
      add_field_problems(value, rules, place, source, problems);
    }
    if (innermost && problems.size() == before) {
      problems.push_back({source, place.to_string(), describe(value), expectation(rules)});
    }
  }
  check(!problems.empty(), "a job that breaks the schema has a problem");
  return problems;
}

}  // namespace throng::jobs
