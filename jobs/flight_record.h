// What is known of a drone when one of its pictures is taken: the truth, and what its sensors say.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "jobs/spec.h"
#include "sim/gimbal.h"
#include "sim/sensors.h"
#include "world/trace.h"

namespace throng::jobs {

/// The sensors of one of the job's drones in a run.
sim::SensorLog sensors_of(const JobSpec& job, std::uint64_t run_seed,
                          const std::vector<world::DroneSample>& truth, std::size_t drone);

/// The object `flight` of an image: "true" and "measured" (docs/formats.md).
nlohmann::json flight_record(const world::DroneSample& truth, const sim::SensorReading& reading,
                             const sim::ViewAngles& view, const sim::ViewAngles& gimbal_reading,
                             const sim::SensorNoise& noise);

/// All readings of a drone beside the truth, as a table with a line per sample
/// (sensors/run000/d1.csv).
std::string sensors_csv(const std::vector<world::DroneSample>& truth, const sim::SensorLog& log);

}  // namespace throng::jobs
