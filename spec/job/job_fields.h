// The tables of all fields of a job, in the order of the schema.
#pragma once

#include "spec/job/field_table.h"
#include "spec/job/job_spec.h"

namespace throng::jobs {

/// All fields except those of an element of "drones".
const FieldTable<JobSpec>& job_fields();
/// The fields of an element of "drones".
const FieldTable<DroneSpec>& drone_fields();
/// Adds the fields below "outputs" to the table that job_fields() returns.
void add_output_fields(FieldTable<JobSpec>& table);

/// The JSON Schema made from the tables, in their order.
const nlohmann::ordered_json& ordered_job_schema();

/// Sets a field, given by its JSON pointer, to the value sampled for a run. The block "randomize"
/// must permit the field.
void set_field(JobSpec& job, const std::string& pointer, const nlohmann::json& value);

}  // namespace throng::jobs
