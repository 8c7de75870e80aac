// Light, weather and wind of a job, and their sampled values in each run.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "spec/job/distribution.h"
#include "spec/job/field_table.h"
#include "spec/job/wind_spec.h"
#include "spec/render/environment.h"
#include "spec/sun/sun.h"

namespace throng::jobs {

/// The fields below "environment". `weather` holds values of render::Weather as numbers.
struct EnvironmentSpec {
  Distribution time_of_day_h{15.5};
  Distribution latitude_deg{kUsualLatitudeDeg};
  Distribution day_of_year{kUsualDayOfYear};
  Distribution weather{0};
  std::optional<Distribution> visibility_m;  ///< default: by the weather
  Distribution rain_mm_per_h{4};
  Distribution smoke{0};
  WindFields wind;
};

/// The fields in the order of the schema.
const FieldTable<EnvironmentSpec>& environment_fields();

/// Reads the object; fields that it omits keep their defaults. Adds to `problems`, with JSON
/// pointers.
EnvironmentSpec read_environment(const nlohmann::json& value, std::vector<Problem>& problems);

nlohmann::json to_json(const EnvironmentSpec& spec);

/// Values sampled for a run; `light` contains the resulting direction of the sun.
struct RunEnvironment {
  double time_of_day_h = 0;
  double latitude_deg = 0;
  int day_of_year = 1;
  render::Environment light;
  sim::WindSpec wind;
};

RunEnvironment environment_of_run(const EnvironmentSpec& spec, std::uint64_t run_seed);

/// A run's environment as recorded in the manifest and with every image.
nlohmann::json to_json(const RunEnvironment& environment);

}  // namespace throng::jobs
