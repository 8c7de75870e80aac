// The tables of a job's fields: everything that a job may say, in the order of the schema.
#pragma once

#include "spec/job/field_table.h"
#include "spec/job/job_spec.h"

namespace throng::jobs {

/// All fields but those of single drones.
const FieldTable<JobSpec>& job_fields();
/// Those of an element of "drones".
const FieldTable<DroneSpec>& drone_fields();
/// The fields below "outputs", for job_fields().
void add_output_fields(FieldTable<JobSpec>& table);

/// The JSON Schema that follows from the tables, in their order.
const nlohmann::ordered_json& ordered_job_schema();

/// Sets what was sampled for a run: a field that the block "randomize" may name, by its JSON
/// pointer.
void set_field(JobSpec& job, const std::string& pointer, const nlohmann::json& value);

}  // namespace throng::jobs
