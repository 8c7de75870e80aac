// The wind of a job, and its sampled values in each run.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "spec/job/distribution.h"
#include "spec/job/field_table.h"
#include "spec/sim/wind_spec.h"

namespace throng::jobs {

/// The fields below "environment/wind". `profile` and `gusts` hold values of sim::WindProfile and
/// sim::GustModel as numbers.
struct WindFields {
  Distribution speed_mps{0};
  Distribution direction_deg{0};
  Distribution profile{1};
  Distribution roughness_m{0.4};
  Distribution exponent{0.25};
  Distribution gusts{1};
  Distribution intensity{1};
  Distribution gust_mps{1.5};
  Distribution gust_time_s{3};
};

/// The fields in the order of the schema.
const FieldTable<WindFields>& wind_fields();

/// The wind sampled for a run.
sim::WindSpec wind_of_run(const WindFields& fields, std::uint64_t run_seed);

/// A run's wind as recorded in datasets: only the parameters that its models use.
nlohmann::json to_json(const sim::WindSpec& wind);

}  // namespace throng::jobs
