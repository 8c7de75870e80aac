// State of a drone when one of its images is captured: true values and sensor readings.
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

/// The sensors of one of the job's drones in a run; `drone` is its index in the job.
sim::DroneSensors make_sensors(const JobSpec& job, std::uint64_t run_seed, std::size_t drone);

/// Their readings at the samples of a trace.
sim::SensorLog record_sensors(const JobSpec& job, std::uint64_t run_seed,
                              const std::vector<world::DroneSample>& truth, std::size_t drone);

/// A drone and its camera at one time: true values and sensor readings.
struct FlightMoment {
  world::DroneSample truth;
  sim::ViewAngles view;
  camera::Camera camera;
  sim::SensorReading reading;
  sim::ViewAngles gimbal_reading;
};

/// The rows in which the horizon of level ground crosses the first and the last column, in pixels
/// by OpenCV's convention of the image without lens distortion; null if the camera looks straight
/// down, so that the horizon crosses no column.
nlohmann::json horizon_rows(const camera::Camera& camera);

/// The object `flight` of an image: "true" and "measured" (docs/formats.md).
nlohmann::json flight_record(const FlightMoment& moment, const sim::SensorNoise& noise);

/// A CSV table of a drone's sensor readings and true values, one line per sample
/// (sensors/run000/d1.csv).
std::string sensors_csv(const std::vector<world::DroneSample>& truth, const sim::SensorLog& log);

}  // namespace throng::jobs
