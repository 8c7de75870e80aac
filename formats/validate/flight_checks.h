// The drone that carries the camera: its record with each image, and the tables of its sensors.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "formats/dataset/dataset.h"
#include "formats/validate/findings.h"
#include "formats/validate/ground_truth_checks.h"

namespace throng::formats {

/// The truth of a moment and what the sensors read then: m, m/s, rad/s, m/s², µT, Pa; body's frame
/// where the sensor has it.
struct SensorSample {
  Eigen::Vector3d position;
  Eigen::Vector3d velocity;
  Eigen::Quaterniond orientation;  ///< body to world
  Eigen::Vector3d body_rates;
  Eigen::Vector3d specific_force;
  Eigen::Vector3d gyro;
  Eigen::Vector3d accelerometer;
  Eigen::Vector3d magnetometer;
  double pressure_pa;
  double height_m;
  Eigen::Vector3d gps_position;
  Eigen::Vector3d gps_velocity;
  double max_jump_mps = 0;  ///< by which contact may have changed the velocity at once
};

/// Whether the drone's figures in metrics/RUN.json say that it may have touched something:
/// collisions are of 0.3 m/s and more, slower touches near misses. A drone without figures may not.
bool may_have_touched(const DatasetInfo& info, const std::string& run, const std::string& drone);

/// Names a reading beyond six standard deviations of the sensors' errors; "" if there is none. The
/// readings are at most `age_s` older than the truth, the GPS fix `gps_age_s`.
std::string implausible_reading(const SensorSample& sample, double latitude_deg, double age_s,
                                double gps_age_s);

/// An image's flight record: camera, gimbal, sensors. Of a drone that may have touched something,
/// velocity may jump.
void check_flight(const Image& image, Findings& findings, bool may_touch = false);

/// Flight records of consecutive frames of one camera.
void check_flight_between(const Image& before, const Image& after, Findings& findings,
                          bool may_touch = false);

/// sensors/RUN/DRONE.csv: rows follow from each other, readings from the truth, and the flight
/// records of the images are between the rows.
class SensorTableCheck : public GroundTruthCheck {
 public:
  void add(const DatasetInfo& info, const Image& image, Findings& findings) override;

 private:
  struct Table {
    std::vector<std::vector<double>> rows;  ///< 39 columns
    bool is_read = false;
  };
  std::map<std::string, Table> tables_;
};

}  // namespace throng::formats
