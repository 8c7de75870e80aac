// The fields below "outputs" for counts on the ground: cells, zones and lines.
#pragma once

#include "spec/job/field_table.h"
#include "spec/job/job_spec.h"

namespace throng::jobs {

void add_ground_fields(FieldTable<JobSpec>& table);

}  // namespace throng::jobs
