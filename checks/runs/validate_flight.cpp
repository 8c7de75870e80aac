// The flight record of an image against its camera, its sensors' errors and the flight before.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/geometry/angle.h"
#include "checks/flight_checks.h"
#include "formats/files/json_vectors.h"

namespace throng::checks {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

/// ISO 2533, and the height that a pressure stands for.
constexpr double kSeaLevelPa = 101'325;
constexpr double kLapsePerM = 2.25577e-5;
constexpr double kPressureExponent = 5.25588;
double pressure_at(double height_m) {
  return kSeaLevelPa * std::pow(1 - kLapsePerM * height_m, kPressureExponent);
}
double height_at(double pressure_pa) {
  return (1 - std::pow(pressure_pa / kSeaLevelPa, 1 / kPressureExponent)) / kLapsePerM;
}

/// A dipole's field at a latitude, +y being north, microtesla.
Vector3d field_at(double latitude_deg) {
  constexpr double kEquatorUt = 30;
  return kEquatorUt *
         Vector3d(0, std::cos(latitude_deg * kDegree), -2 * std::sin(latitude_deg * kDegree));
}

/// Standard deviation of a reading along the noisiest axis, 60 readings a second.
double reading_sd(const sim::InertialNoise& noise) {
  constexpr double kReadingsHz = 60;
  return std::hypot(noise.turn_on, noise.walk * std::sqrt(0.5 * noise.walk_s),
                    noise.density.maxCoeff() * std::sqrt(kReadingsHz));
}

bool are_alike(double a, double b, double slack) { return std::abs(a - b) <= slack; }

/// World to camera, of a camera that looks at a heading and an angle above the horizon and is
/// turned clockwise about that. Angles are not compared: close to straight down there are two sets
/// of them for one view, a pitch beyond -90 degrees among these.
Eigen::Matrix3d read_rotation(const json& gimbal) {
  const auto angle = [&](const char* key) { return gimbal.at(key).get<double>() * kDegree; };
  const double yaw = angle("yaw_deg");
  const double pitch = angle("pitch_deg");
  const double roll = angle("roll_deg");
  const Vector3d ahead(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw),
                       std::sin(pitch));
  const Vector3d level_right(std::sin(yaw), -std::cos(yaw), 0);
  const Vector3d level_down = ahead.cross(level_right);
  Eigen::Matrix3d R;
  R.row(0) = std::cos(roll) * level_right + std::sin(roll) * level_down;
  R.row(1) = std::cos(roll) * level_down - std::sin(roll) * level_right;
  R.row(2) = ahead;
  return R;
}

/// The angle between two orientations, degrees.
double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Quaterniond(a).angularDistance(Quaterniond(b)) / kDegree;
}

class FlightRecord {
 public:
  FlightRecord(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings,
               bool may_touch)
      : noise_(info.sensor_noise.find(image.camera)),
        is_noise_known_(noise_ != info.sensor_noise.end()),
        image_(image),
        flight_(image.record.at("flight")),
        findings_(findings),
        may_touch_(may_touch) {}

  void check() const {
    check_camera();
    check_gimbal();
    check_measured();
  }

 private:
  void fault(const std::string& what) const {
    findings_.add("flight", formats::kCocoFile, fmt::format("image {}", image_.id), what);
  }

  void check_camera() const {
    const json& truth = flight_.at("true");
    const Vector3d position = formats::numbers_at<3>(truth.at("position"));
    const Vector3d center = -image_.R.transpose() * image_.t;
    const Quaterniond body = formats::quaternion_at(truth.at("orientation_wxyz"));
    const auto mount = truth.find("mount_m");
    const Vector3d from_body = mount == truth.end()
                                   ? Vector3d::Zero().eval()
                                   : Vector3d(body * formats::numbers_at<3>(*mount));
    const double off_m = (position + from_body - center).norm();
    if (!(off_m <= 1e-6 * (1 + center.norm()))) {
      fault(fmt::format(
          "flight.true.position is {:.3f} m from the camera's center, mount_m counted", off_m));
    }
    if (!are_alike(truth.at("height_m").get<double>(), position.z(), 1e-6)) {
      fault("flight.true.height_m is not the position's z");
    }
    if (!are_alike(truth.at("time_s").get<double>(), image_.time_s, 1e-6)) {
      fault("flight.true.time_s is not time_s");
    }
    if (!are_alike(body.norm(), 1, 1e-6)) fault("flight.true.orientation_wxyz has not length 1");
    const Quaterniond camera = formats::quaternion_at(truth.at("camera_orientation_wxyz"));
    if (!((camera.toRotationMatrix() - image_.R.transpose()).norm() <= 1e-6)) {
      fault("flight.true.camera_orientation_wxyz is not the inverse of the camera's R");
    }
    check_horizon(truth);
  }

  void check_horizon(const json& truth) const {
    const auto rows = truth.find("horizon_rows");
    if (rows == truth.end() || rows->is_null()) return;
    const Eigen::Matrix3d& K = image_.camera_matrix;
    const Vector3d up = image_.R.col(2);
    if (std::abs(up.y()) < 1e-3) return;
    for (const std::size_t side : {0U, 1U}) {
      const double column = side == 0 ? 0 : image_.width - 1;
      const double expected =
          K(1, 2) - K(1, 1) * (up.z() + up.x() * (column - K(0, 2)) / K(0, 0)) / up.y();
      const double found = rows->at(side).get<double>();
      if (are_alike(found, expected, 1e-3 * (1 + std::abs(expected)))) continue;
      fault(
          fmt::format("flight.true.horizon_rows[{}] is {:.2f}, but the camera's horizon is at "
                      "{:.2f}",
                      side, found, expected));
      return;
    }
  }

  void check_gimbal() const {
    const auto off = [&](const json& gimbal) {
      return angle_between(read_rotation(gimbal), image_.R);
    };
    const double truth = off(flight_.at("true").at("gimbal"));
    if (truth > 0.01) {
      fault(fmt::format("flight.true.gimbal is {:.3f} degrees from where the camera looks", truth));
    }
    // Bias and noise of the job's gimbal are within a few degrees; per-frame turns are not its own.
    constexpr double kMaxReadingDeg = 12;
    const double reading = off(flight_.at("measured").at("gimbal"));
    if (reading > kMaxReadingDeg &&
        !image_.record.value("drawn", json::object()).contains("frame.yaw_deg")) {
      fault(fmt::format("flight.measured.gimbal is {:.2f} degrees from where the camera looks",
                        reading));
    }
  }

  void check_measured() const {
    const json& measured = flight_.at("measured");
    const json& truth = flight_.at("true");
    const double age_s = image_.time_s - measured.at("time_s").get<double>();
    if (!(age_s >= -1e-6 && age_s <= kMaxAgeS)) {
      fault(fmt::format("flight.measured.time_s is {:.3f} s before time_s", age_s));
    }
    const double latitude_deg =
        image_.record.value("environment", json::object()).value("latitude_deg", 45.0);
    const SensorSample sample{formats::numbers_at<3>(truth.at("position")),
                              formats::numbers_at<3>(truth.at("velocity")),
                              formats::quaternion_at(truth.at("orientation_wxyz")),
                              formats::numbers_at<3>(truth.at("body_rates")),
                              formats::numbers_at<3>(truth.at("specific_force")),
                              formats::numbers_at<3>(measured.at("gyro")),
                              formats::numbers_at<3>(measured.at("accelerometer")),
                              formats::numbers_at<3>(measured.at("magnetometer_ut")),
                              measured.at("pressure_pa").get<double>(),
                              measured.at("height_m").get<double>(),
                              formats::numbers_at<3>(measured.at("gps").at("position")),
                              formats::numbers_at<3>(measured.at("gps").at("velocity")),
                              may_touch_ ? kMaxImpactMps : 0};
    const double gps_age_s = image_.time_s - measured.at("gps").at("time_s").get<double>();
    if (!(gps_age_s >= -1e-6 && gps_age_s <= kMaxGpsAgeS)) {
      fault(fmt::format("the GPS fix is {:.3f} s old", gps_age_s));
    }
    if (!is_noise_known_) return;
    const std::string what =
        implausible_reading(sample, noise_->second, latitude_deg, kMaxAgeS, kMaxGpsAgeS);
    if (!what.empty()) fault("flight.measured: " + what);
  }

  static constexpr double kMaxAgeS = 0.05;  // readings come about 60 times a second
  static constexpr double kMaxGpsAgeS = 0.45;

  std::map<std::string, sim::SensorNoise>::const_iterator noise_;
  bool is_noise_known_;
  const formats::Image& image_;
  const json& flight_;
  Findings& findings_;
  bool may_touch_;
};

}  // namespace

std::string implausible_reading(const SensorSample& sample, const sim::SensorNoise& noise,
                                double latitude_deg, double age_s, double gps_age_s) {
  // Six standard deviations of the sensors' errors (docs/drones.md), and what the drone does until
  // then.
  constexpr double kSigmas = 6;
  constexpr double kMaxJerkMps3 = 200;
  constexpr double kMaxTurnRadS2 = 150;
  constexpr double kMaxAccelerationMps2 = 25;
  const auto off = [](const Vector3d& a, const Vector3d& b) {
    return (a - b).cwiseAbs().maxCoeff();
  };
  const double gyro = off(sample.gyro, sample.body_rates);
  if (gyro > kSigmas * reading_sd(noise.gyro) + kMaxTurnRadS2 * age_s * age_s + 0.02 +
                 kMaxTurnRadS2 * 0.02 * age_s) {
    return fmt::format("gyro is {:.3f} rad/s off body_rates", gyro);
  }
  const double force = off(sample.accelerometer, sample.specific_force);
  if (force > kSigmas * reading_sd(noise.accelerometer) + 0.1 + kMaxJerkMps3 * age_s * 0.1) {
    return fmt::format("the accelerometer is {:.2f} m/s2 off specific_force", force);
  }
  const Vector3d field = field_at(latitude_deg);
  const double magnetic = off(sample.magnetometer, sample.orientation.conjugate() * field);
  if (magnetic > kSigmas * noise.field_share * field.norm() + 0.5) {
    return fmt::format("the magnetometer is {:.2f} uT off the field", magnetic);
  }
  if (!are_alike(sample.height_m, height_at(sample.pressure_pa), 0.01)) {
    return fmt::format("height_m is {:.2f}, but the pressure is that of {:.2f} m", sample.height_m,
                       height_at(sample.pressure_pa));
  }
  const double pressure_sd_pa = std::hypot(noise.weather_share * sample.pressure_pa,
                                           noise.pressure_pa, noise.pressure_offset_pa);
  if (!are_alike(sample.pressure_pa, pressure_at(sample.position.z()),
                 kSigmas * pressure_sd_pa + 1)) {
    return fmt::format("pressure_pa is {:.0f}, expected about {:.0f}", sample.pressure_pa,
                       pressure_at(sample.position.z()));
  }
  const Vector3d drift =
      (sample.velocity.cwiseAbs().array() + sample.max_jump_mps).matrix() * gps_age_s +
      Vector3d::Constant(kMaxAccelerationMps2 * gps_age_s * gps_age_s / 2);
  const Vector3d wander(noise.gps_wander_m.x(), noise.gps_wander_m.x(), noise.gps_wander_m.y());
  const Vector3d gps = (sample.gps_position - sample.position).cwiseAbs();
  if (((gps - kSigmas * wander - drift).array() > kSigmas * noise.gps_white_m).any()) {
    return fmt::format("the GPS is ({:.1f}, {:.1f}, {:.1f}) m off the position", gps.x(), gps.y(),
                       gps.z());
  }
  const Vector3d speed = (sample.gps_velocity - sample.velocity).cwiseAbs();
  const double max_speed = kSigmas * noise.gps_velocity_mps.maxCoeff() +
                           kMaxAccelerationMps2 * gps_age_s / 2 + sample.max_jump_mps;
  if (speed.maxCoeff() > max_speed) {
    return fmt::format("the GPS's velocity is ({:.2f}, {:.2f}, {:.2f}) m/s off", speed.x(),
                       speed.y(), speed.z());
  }
  return "";
}

void check_flight(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings,
                  bool may_touch) {
  if (image.record.contains("flight")) FlightRecord(info, image, findings, may_touch).check();
}

void check_flight_between(const formats::Image& before, const formats::Image& after,
                          Findings& findings, bool may_touch) {
  if (!before.record.contains("flight") || !after.record.contains("flight")) return;
  const json& then = before.record.at("flight").at("true");
  const json& now = after.record.at("flight").at("true");
  const double dt_s = after.time_s - before.time_s;
  if (!(dt_s > 0)) return;
  const std::string record = fmt::format("image {}", after.id);
  const Vector3d moved =
      formats::numbers_at<3>(now.at("position")) - formats::numbers_at<3>(then.at("position"));
  const Vector3d mean = 0.5 * (formats::numbers_at<3>(now.at("velocity")) +
                               formats::numbers_at<3>(then.at("velocity")));
  // A quadcopter's acceleration stays below this; the trapezoidal rule is off by a dt² / 8.
  constexpr double kMaxAccelerationMps2 = 8;
  const double slack_m = 0.02 + kMaxAccelerationMps2 * dt_s * dt_s / 8;
  constexpr double kMaxDurationS = 1.1;
  const double off_m = (moved - mean * dt_s).norm();
  if (dt_s <= kMaxDurationS && off_m > slack_m + (may_touch ? kMaxImpactMps * dt_s : 0)) {
    findings.add("flight", formats::kCocoFile, record,
                 fmt::format("the drone moved ({:.2f}, {:.2f}, {:.2f}) m since the last frame, but "
                             "its velocity was ({:.2f}, {:.2f}, {:.2f}) m/s",
                             moved.x(), moved.y(), moved.z(), mean.x(), mean.y(), mean.z()));
  }
  const double used_w =
      3600 * (now.at("energy_wh").get<double>() - then.at("energy_wh").get<double>()) / dt_s;
  constexpr double kMaxPowerW = 5000;
  if (!(used_w >= 0 && used_w < kMaxPowerW)) {
    findings.add("flight", formats::kCocoFile, record,
                 fmt::format("energy_wh grows by {:.0f} W since the last frame", used_w));
  }
}

}  // namespace throng::checks
