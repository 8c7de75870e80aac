#include "spec/documents/published_schemas.h"

#include <array>
#include <nlohmann/json.hpp>

#include "base/json/field_table.h"
#include "spec/blueprint/blueprint_fields.h"
#include "spec/calibration/camera_file.h"
#include "spec/calibration/request.h"
#include "spec/crowd/experiment.h"
#include "spec/job/job_fields.h"
#include "spec/job/schema.h"
#include "spec/sim/airframe_fields.h"
#include "spec/skinning/character_description.h"
#include "spec/study/study_document.h"
#include "world/fields/scenario_fields.h"

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
ordered_json study() {
  const ordered_json& job = ordered_job_schema()["properties"];
  return study::study_schema(job["crowd"], job["drones"]);
}

ordered_json airframe() {
  return fields::document_schema("throng airframe",
                                 "A quadcopter, as drones[].airframe of a job (docs/drones.md).",
                                 sim::airframe_fields().schema());
}

/// A schema, made from a table of fields.
struct Made {
  std::string_view name;
  ordered_json (*schema)();
};

constexpr std::array<Made, 9> kMade = {{{"job", job},
                                        {"scenario", world::scenario_schema},
                                        {"blueprint", scenarios::blueprint_schema},
                                        {"study", study},
                                        {"airframe", airframe},
                                        {"calibration", calibrate::request_schema},
                                        {"camera", calibrate::camera_file_schema},
                                        {"character", skinning::character_schema},
                                        {"experiments", validation::experiments_schema}}};

}  // namespace

std::vector<std::string_view> schema_names() {
  std::vector<std::string_view> names;
  names.reserve(kMade.size());
  for (const Made& made : kMade) names.push_back(made.name);
  return names;
}

std::string published_schema(std::string_view name) {
  for (const Made& made : kMade) {
    if (made.name == name) return fields::schema_text(made.schema());
  }
  return {};
}

}  // namespace throng::jobs
