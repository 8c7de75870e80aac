// Light, weather and wind as a job asks for them and as each run has them.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "spec/job/distribution.h"
#include "spec/job/field_table.h"
#include "spec/job/wind_spec.h"
#include "spec/render/environment.h"

namespace throng::jobs {

/// The fields below "environment". Weather is the number of a render::Weather.
struct EnvironmentSpec {
  Distribution time_of_day_h{15.5};
  Distribution latitude_deg{45};
  Distribution day_of_year{225};
  Distribution weather{0};
  std::optional<Distribution> visibility_m;  ///< without it, by the weather
  Distribution rain_mm_per_h{4};
  Distribution smoke{0};
  WindFields wind;
};

/// In the order of the schema.
const FieldTable<EnvironmentSpec>& environment_fields();

/// Reads the object; what it leaves out keeps its default. Problems carry JSON pointers.
EnvironmentSpec read_environment(const nlohmann::json& value, std::vector<Problem>& problems);

nlohmann::json to_json(const EnvironmentSpec& spec);

/// Values sampled for a run; the sun follows from them.
struct RunEnvironment {
  double time_of_day_h = 0;
  double latitude_deg = 0;
  int day_of_year = 1;
  render::Environment light;
  sim::WindSpec wind;
};

RunEnvironment environment_of_run(const EnvironmentSpec& spec, std::uint64_t run_seed);

/// The record of a run's environment, in the manifest and with every image.
nlohmann::json to_json(const RunEnvironment& environment);

/// The sun's direction.
struct Sun {
  double azimuth_rad = 0;    ///< counter-clockwise from +x (east); +y is north
  double elevation_rad = 0;  ///< negative below the horizon
};

/// Position of the sun at a solar time (hours from midnight): sin(elevation) = sin(lat) sin(dec) +
/// cos(lat) cos(dec) cos(hour angle). The declination is Spencer's Fourier series of the day of the
/// year (Spencer 1971, Search 2(5), p. 172; within 0.05 degrees).
Sun sun_at(double time_of_day_h, double latitude_deg, int day_of_year);

}  // namespace throng::jobs
