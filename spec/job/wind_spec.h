// Wind as a job asks for it and as each run has it.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "spec/job/distribution.h"
#include "spec/job/field_table.h"
#include "spec/sim/wind_spec.h"

namespace throng::jobs {

/// The fields below "environment/wind". Profile and gusts are the numbers of a sim::WindProfile and
/// a sim::GustModel.
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

/// In the order of the schema.
const FieldTable<WindFields>& wind_fields();

/// The wind sampled for a run.
sim::WindSpec wind_of_run(const WindFields& fields, std::uint64_t run_seed);

/// The record of a run's wind: only what matters for its models.
nlohmann::json to_json(const sim::WindSpec& wind);

}  // namespace throng::jobs
