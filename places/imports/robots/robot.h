// A robot as its description (SDF, URDF) states it, before it becomes an airframe. Vectors are in
// the robot's frame (x ahead, y left, z up) unless they say otherwise. SI units.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "places/imports/gazebo/camera_sensor.h"
#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// A rotor: a joint or link whose plugin states the constants of motor and propeller.
struct RobotRotor {
  std::string name;  ///< of its link
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double sense = 1;  ///< +1: counter-clockwise from above
  int number = 0;    ///< of the motor
  double thrust_n_s2 = 0;
  double torque_per_thrust_m = 0;
  double max_rad_s = 0;
  double up_s = 0;  ///< time constant of acceleration
  double down_s = 0;
  double drag_n_s2_m = 0;
  std::optional<double> radius_m;  ///< of the propeller, from its shape
};

/// Errors of a gyroscope or accelerometer, as spec/sim/sensor_noise.h has them.
struct RobotInertialNoise {
  Eigen::Vector3d density = Eigen::Vector3d::Zero();
  double walk = 0;
  std::optional<double> walk_s;
  double turn_on = 0;
};

/// Errors of sensors; what the description does not state is missing.
struct RobotSensors {
  std::optional<RobotInertialNoise> gyroscope;
  std::optional<RobotInertialNoise> accelerometer;
  std::optional<double> gps_hz;
  std::optional<double> gps_white_m;
  std::optional<Eigen::Vector2d> gps_wander_m;      ///< [horizontal, vertical]
  std::optional<Eigen::Vector2d> gps_velocity_mps;  ///< [horizontal, vertical]
  std::optional<double> pressure_pa;
  std::optional<double> pressure_offset_pa;
  std::optional<double> field_share;
};

struct Robot {
  std::string name;
  double mass_kg = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the center of mass, kg m²
  std::vector<RobotRotor> rotors;                     ///< by their numbers
  std::vector<CameraSensor> cameras;                  ///< in the order of the file
  RobotSensors sensors;
  std::optional<double> battery_wh;
  std::optional<double> height_m;  ///< of the collision shapes
  bool has_hector_propulsion = false;
  std::vector<Skipped> skipped;  ///< elements without counterpart
};

}  // namespace throng::imports
