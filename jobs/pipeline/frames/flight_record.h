// State of a drone when one of its images is captured: the truth, and its sensors' readings.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "sim/sensors/gimbal.h"
#include "sim/sensors/sensors.h"
#include "spec/job/spec.h"
#include "world/trace.h"

namespace throng::jobs {

/// The sensors of one of the job's drones in a run.
sim::SensorLog record_sensors(const JobSpec& job, std::uint64_t run_seed,
                              const std::vector<world::DroneSample>& truth, std::size_t drone);

/// A drone and its camera at one time, and what is said of them then.
struct FlightMoment {
  world::DroneSample truth;
  sim::ViewAngles view;
  camera::Camera camera;
  sim::SensorReading reading;
  sim::ViewAngles gimbal_reading;
};

/// The rows (OpenCV's pixels, in the image that the lens would make without distortion) in which
/// the horizon of level ground crosses the first and the last column; null where it crosses no
/// columns, since the camera looks straight down.
nlohmann::json horizon_rows(const camera::Camera& camera);

/// The object `flight` of an image: "true" and "measured" (docs/formats.md).
nlohmann::json flight_record(const FlightMoment& moment, const sim::SensorNoise& noise = {});

/// All readings of a drone beside the truth, as a table with a line per sample
/// (sensors/run000/d1.csv).
std::string sensors_csv(const std::vector<world::DroneSample>& truth, const sim::SensorLog& log);

}  // namespace throng::jobs
