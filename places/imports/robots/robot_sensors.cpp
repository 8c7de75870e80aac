#include "places/imports/robots/robot_sensors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "places/imports/gazebo/camera_sensor.h"

namespace throng::imports {

namespace {

using Eigen::Vector3d;

constexpr double kUsualRateHz = 100;

/// Standard deviation of a noise; 0 for none.
double deviation(const sdf::Noise& noise) {
  return noise.Type() == sdf::NoiseType::NONE ? 0 : noise.StdDev();
}

double sensor_rate_hz(const sdf::Sensor& sensor) {
  return sensor.UpdateRate() > 0 ? sensor.UpdateRate() : kUsualRateHz;
}

RobotInertialNoise inertial_noise(const sdf::Noise& x, const sdf::Noise& y, const sdf::Noise& z,
                                  double rate_hz) {
  RobotInertialNoise noise;
  noise.density = Vector3d(deviation(x), deviation(y), deviation(z)) / std::sqrt(rate_hz);
  // As gz-sensors drives its bias: white noise of this density through the correlation time.
  noise.walk = std::max({x.DynamicBiasStdDev(), y.DynamicBiasStdDev(), z.DynamicBiasStdDev()});
  if (x.DynamicBiasCorrelationTime() > 0) noise.walk_s = x.DynamicBiasCorrelationTime();
  noise.turn_on = std::max({x.BiasStdDev(), y.BiasStdDev(), z.BiasStdDev()});
  return noise;
}

void read_imu(const RobotSource& source, const sdf::Sensor& sensor, bool is_movable, Robot& robot) {
  const sdf::Imu* imu = sensor.ImuSensor();
  if (is_movable || imu == nullptr || robot.sensors.gyroscope) {
    robot.skipped.push_back(source.skipped(
        sensor.Element(), "sensor " + sensor.Name(),
        imu == nullptr ? "an IMU that states no noise" : "another IMU than the body's first"));
    return;
  }
  const double rate_hz = sensor_rate_hz(sensor);
  robot.sensors.gyroscope =
      inertial_noise(imu->AngularVelocityXNoise(), imu->AngularVelocityYNoise(),
                     imu->AngularVelocityZNoise(), rate_hz);
  robot.sensors.accelerometer =
      inertial_noise(imu->LinearAccelerationXNoise(), imu->LinearAccelerationYNoise(),
                     imu->LinearAccelerationZNoise(), rate_hz);
}

void read_magnetometer(const RobotSource& source, const sdf::Sensor& sensor, Robot& robot) {
  constexpr double kFieldT = 4.9e-5;  // of the Earth at middle latitudes
  const sdf::Magnetometer* magnetometer = sensor.MagnetometerSensor();
  if (magnetometer == nullptr) return;
  const double share =
      std::max({deviation(magnetometer->XNoise()), deviation(magnetometer->YNoise()),
                deviation(magnetometer->ZNoise())}) /
      kFieldT;
  if (share > 1) {
    robot.skipped.push_back(
        source.skipped(sensor.Element(), "sensor " + sensor.Name() + " <noise>",
                       fmt::format("{:g} T, more than the field of the Earth", share * kFieldT)));
    return;
  }
  robot.sensors.field_share = share;
}

void read_navsat(const sdf::Sensor& sensor, Robot& robot) {
  RobotSensors& sensors = robot.sensors;
  if (sensor.UpdateRate() > 0) sensors.gps_hz = sensor.UpdateRate();
  const sdf::NavSat* navsat = sensor.NavSatSensor();
  if (navsat == nullptr) return;
  const auto is_given = [](const sdf::Noise& noise) {
    return noise.Type() != sdf::NoiseType::NONE;
  };
  if (is_given(navsat->HorizontalPositionNoise()) || is_given(navsat->VerticalPositionNoise())) {
    sensors.gps_white_m = std::max(deviation(navsat->HorizontalPositionNoise()),
                                   deviation(navsat->VerticalPositionNoise()));
    sensors.gps_wander_m = Eigen::Vector2d::Zero();
  }
  if (is_given(navsat->HorizontalVelocityNoise()) || is_given(navsat->VerticalVelocityNoise())) {
    sensors.gps_velocity_mps = Eigen::Vector2d(deviation(navsat->HorizontalVelocityNoise()),
                                               deviation(navsat->VerticalVelocityNoise()));
  }
}

void read_camera(const RobotSource& source, const sdf::Sensor& sensor,
                 const Eigen::Isometry3d& link, bool is_movable, Robot& robot) {
  auto camera = read_camera_sensor(sensor, link);
  if (!camera) {
    throw InputError(source.problem(sensor.Element(), "camera " + sensor.Name(),
                                    "a <camera>, and a pose relative to a frame that exists"));
  }
  camera->is_movable = is_movable;
  if (camera->has_noise) {
    robot.skipped.push_back(source.skipped(sensor.Element(), "camera " + camera->name + " <noise>",
                                           "a job's camera.sensor has the noise of images"));
  }
  robot.cameras.push_back(std::move(*camera));
}

}  // namespace

void read_sensor(const RobotSource& source, const sdf::Sensor& sensor,
                 const Eigen::Isometry3d& link, bool is_movable, Robot& robot) {
  if (is_camera(sensor)) return read_camera(source, sensor, link, is_movable, robot);
  switch (sensor.Type()) {
    case sdf::SensorType::IMU:
      return read_imu(source, sensor, is_movable, robot);
    case sdf::SensorType::MAGNETOMETER:
      return read_magnetometer(source, sensor, robot);
    case sdf::SensorType::AIR_PRESSURE:
      if (sensor.AirPressureSensor() != nullptr) {
        robot.sensors.pressure_pa = deviation(sensor.AirPressureSensor()->PressureNoise());
      }
      return;
    case sdf::SensorType::GPS:
    case sdf::SensorType::NAVSAT:
      return read_navsat(sensor, robot);
    default:
      robot.skipped.push_back(source.skipped(
          sensor.Element(), fmt::format("sensor {} ({})", sensor.Name(), sensor.TypeStr()),
          "drones have no such sensor"));
  }
}

}  // namespace throng::imports
