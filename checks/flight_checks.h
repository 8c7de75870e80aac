// Checks of the drone that carries the camera: its record in each image, and its sensor tables.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "checks/findings.h"
#include "checks/ground_truth_checks.h"
#include "formats/dataset/dataset.h"

namespace throng::checks {

/// Greatest speed with which a drone flies or falls against something.
inline constexpr double kMaxImpactMps = 25;

/// True state and sensor readings at one time, in m, m/s, rad/s, m/s², µT and Pa. Rates, specific
/// force, gyro, accelerometer and magnetometer are in the body frame.
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
  double max_jump_mps = 0;  ///< max sudden change of the velocity by contact
};

/// Whether the drone may have touched an object, by its metrics in metrics/RUN.json: contacts of
/// 0.3 m/s and more are collisions, slower ones near misses. False for a drone without metrics.
bool may_have_touched(const formats::DatasetInfo& info, const std::string& run,
                      const std::string& drone);

/// Describes a reading beyond six standard deviations of the sensors' errors; "" if there is none.
/// Readings are at most `age_s` older than the true state, the GPS fix at most `gps_age_s`.
std::string implausible_reading(const SensorSample& sample, const sim::SensorNoise& noise,
                                double latitude_deg, double age_s, double gps_age_s);

/// Checks an image's flight record: camera, gimbal, sensors. `may_touch` permits jumps of the
/// velocity.
void check_flight(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings,
                  bool may_touch = false);

/// Compares the flight records of consecutive frames of one camera.
void check_flight_between(const formats::Image& before, const formats::Image& after,
                          Findings& findings, bool may_touch = false);

/// Checks sensors/RUN/DRONE.csv: each row against the previous one, readings against the true
/// state, and the flight records of the images against the rows.
class SensorTableCheck : public GroundTruthCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image,
           Findings& findings) override;

 private:
  struct Table {
    std::vector<std::vector<double>> rows;  ///< 39 columns
    bool is_read = false;
  };
  std::map<std::string, Table> tables_;
};

}  // namespace throng::checks
