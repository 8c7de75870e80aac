#include "spec/documents/published_schemas.h"

#include <array>
#include <nlohmann/json.hpp>

#include "base/json/field_table.h"
#include "base/json/json_text.h"
#include "base/schemas/schemas.h"
#include "spec/calibration/request.h"
#include "spec/job/job_fields.h"
#include "spec/job/schema.h"
#include "spec/sim/airframe_fields.h"
#include "spec/skinning/character_description.h"

namespace throng::jobs {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr const char* kSchemaMember = "$schema";

ordered_json job() {
  ordered_json schema = ordered_job_schema();
  schema["properties"][kSchemaMember] = {
      {"description", "The schema that an editor completes and checks with."}, {"type", "string"}};
  return schema;
}

/// The parts that a study takes over from jobs are described as in a job.
json study(std::string_view text) {
  json schema = parse_json(text, "study.schema.json");
  for (const char* part : {"crowd", "drones"}) {
    schema["definitions"][part] = job_schema()["properties"][part];
  }
  return schema;
}

ordered_json airframe() {
  return fields::document_schema("throng airframe",
                                 "A quadcopter, as drones[].airframe of a job (docs/drones.md).",
                                 sim::airframe_fields().schema());
}

/// A schema that is made from a table of fields.
struct Made {
  std::string_view name;
  ordered_json (*schema)();
};

constexpr std::array<Made, 4> kMade = {{{"job", job},
                                        {"airframe", airframe},
                                        {"calibration", calibrate::request_schema},
                                        {"character", skinning::character_schema}}};

}  // namespace

std::vector<std::string_view> schema_names() {
  std::vector<std::string_view> names;
  names.reserve(kMade.size() + schemas::entries().size());
  for (const Made& made : kMade) names.push_back(made.name);
  for (const schemas::Entry& entry : schemas::entries()) names.push_back(entry.name);
  return names;
}

std::string published_schema(std::string_view name) {
  for (const Made& made : kMade) {
    if (made.name == name) return fields::schema_text(made.schema());
  }
  for (const schemas::Entry& entry : schemas::entries()) {
    if (entry.name != name) continue;
    if (entry.kind == schemas::Kind::study) return study(entry.text).dump(1) + "\n";
    return std::string(entry.text);
  }
  return {};
}

}  // namespace throng::jobs
