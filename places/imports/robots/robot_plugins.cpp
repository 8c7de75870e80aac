#include "places/imports/robots/robot_plugins.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "places/imports/gazebo/motor_plugin.h"
#include "places/imports/robots/robot_elements.h"

namespace throng::imports {

namespace {

/// The name of the link, or of the joint that turns it.
std::string link_of_motor(const sdf::ElementPtr& plugin) {
  const std::string link = text_in(plugin, "linkName");
  return link.empty() ? text_in(plugin, "jointName") : link;
}

double required(const RobotSource& source, const sdf::ElementPtr& plugin, const std::string& name) {
  const auto value = number_in(source, plugin, name);
  if (value) return *value;
  throw InputError(
      source.problem(plugin, fmt::format("a motor without <{}>", name), fmt::format("<{}>", name)));
}

/// A motor's plugin of Gazebo ("gz-sim-multicopter-motor-model-system"), PX4
/// ("libgazebo_motor_model.so") or RotorS, whose elements have the same names and units.
void read_motor(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  RobotRotor rotor;
  rotor.name = link_of_motor(plugin);
  const std::string turning = text_in(plugin, "turningDirection");
  if (turning != "cw" && turning != "ccw") {
    throw InputError(
        source.problem(plugin, fmt::format("<turningDirection> \"{}\"", turning), "cw or ccw"));
  }
  rotor.sense = turning == "ccw" ? 1 : -1;
  rotor.number = static_cast<int>(
      number_in(source, plugin, "motorNumber").value_or(static_cast<double>(robot.rotors.size())));
  rotor.thrust_n_s2 = required(source, plugin, "motorConstant");
  rotor.torque_per_thrust_m = required(source, plugin, "momentConstant");
  rotor.max_rad_s = required(source, plugin, "maxRotVelocity");
  rotor.up_s = required(source, plugin, "timeConstantUp");
  rotor.down_s = required(source, plugin, "timeConstantDown");
  rotor.drag_n_s2_m = number_in(source, plugin, "rotorDragCoefficient").value_or(0);
  if (number_in(source, plugin, "rollingMomentCoefficient").value_or(0) != 0) {
    robot.skipped.push_back(source.skipped(plugin, rotor.name + " <rollingMomentCoefficient>",
                                           "rotors have no rolling moment"));
  }
  robot.rotors.push_back(std::move(rotor));
}

void read_battery(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  const auto volts = number_in(source, plugin, "voltage");
  const auto ampere_hours = number_in(source, plugin, "capacity");
  if (volts && ampere_hours) {
    robot.battery_wh = *volts * *ampere_hours;
    return;
  }
  robot.skipped.push_back(
      source.skipped(plugin, "battery", "without <voltage> and <capacity> it has no energy"));
}

/// hector_gazebo_plugins' sensor models: white noise at the update rate, and a drift whose
/// correlation time is an hour, which is an error that is constant in a flight.
void read_hector_imu(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  const double rate_hz = number_in(source, plugin, "updateRate").value_or(100);
  const auto noise = [&](const char* white, const char* drift) {
    RobotInertialNoise errors;
    const Eigen::Vector3d deviation =
        axes_in(source, plugin, white).value_or(Eigen::Vector3d::Zero());
    errors.density = deviation / std::sqrt(std::max(rate_hz, 1.0));
    errors.turn_on = axes_in(source, plugin, drift).value_or(Eigen::Vector3d::Zero()).maxCoeff();
    return errors;
  };
  robot.sensors.gyroscope = noise("rateGaussianNoise", "rateDrift");
  robot.sensors.accelerometer = noise("accelGaussianNoise", "accelDrift");
}

void read_hector_gps(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  RobotSensors& sensors = robot.sensors;
  sensors.gps_hz = number_in(source, plugin, "updateRate");
  const auto pair = [](const Eigen::Vector3d& axes) {
    return Eigen::Vector2d(axes.head<2>().maxCoeff(), axes.z());
  };
  if (const auto white = axes_in(source, plugin, "gaussianNoise")) {
    sensors.gps_white_m = white->maxCoeff();
  }
  if (const auto drift = axes_in(source, plugin, "drift")) sensors.gps_wander_m = pair(*drift);
  if (const auto white = axes_in(source, plugin, "velocityGaussianNoise")) {
    sensors.gps_velocity_mps = pair(*white);
  }
}

/// Heights in meters, as pressures near sea level.
void read_hector_baro(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  constexpr double kPaPerMeter = 12;
  const auto pressure = [&](const char* name) -> std::optional<double> {
    const auto meters = number_in(source, plugin, name);
    if (!meters) return std::nullopt;
    return kPaPerMeter * *meters;
  };
  robot.sensors.pressure_pa = pressure("gaussianNoise");
  robot.sensors.pressure_offset_pa = pressure("drift");
}

void read_hector_magnetic(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  if (const auto white = axes_in(source, plugin, "gaussianNoise")) {
    robot.sensors.field_share = white->maxCoeff();  // of a field of length 1
  }
}

/// The IMU of RotorS and of PX4 for Gazebo classic, which states densities.
void read_density_imu(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  const auto noise = [&](const std::string& sensor) -> std::optional<RobotInertialNoise> {
    const auto density = number_in(source, plugin, sensor + "NoiseDensity");
    if (!density) return std::nullopt;
    RobotInertialNoise errors;
    errors.density.setConstant(*density);
    errors.walk = number_in(source, plugin, sensor + "RandomWalk").value_or(0);
    errors.walk_s = number_in(source, plugin, sensor + "BiasCorrelationTime");
    errors.turn_on = number_in(source, plugin, sensor + "TurnOnBiasSigma").value_or(0);
    return errors;
  };
  robot.sensors.gyroscope = noise("gyroscope");
  robot.sensors.accelerometer = noise("accelerometer");
}

struct KnownPlugin {
  std::string_view in_name;  ///< of the library's file
  void (*read)(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot);
};

constexpr std::array<KnownPlugin, 6> kKnown = {{
    {"battery", read_battery},
    {"hector_gazebo_ros_imu", read_hector_imu},
    {"hector_gazebo_ros_gps", read_hector_gps},
    {"hector_gazebo_ros_baro", read_hector_baro},
    {"hector_gazebo_ros_magnetic", read_hector_magnetic},
    {"gazebo_imu_plugin", read_density_imu},
}};

/// Plugins whose task throng does anyway.
constexpr std::array<std::string_view, 10> kNeedless = {"ros_camera",
                                                        "ros_p3d",
                                                        "ros_control",
                                                        "state-publisher",
                                                        "joint-position-controller",
                                                        "odometry",
                                                        "pose-publisher",
                                                        "mavlink_interface",
                                                        "groundtruth",
                                                        "quadrotor_simple_controller"};

bool has(const std::string& text, std::string_view word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

void read_plugin(const RobotSource& source, const sdf::ElementPtr& plugin, Robot& robot) {
  if (is_motor(plugin)) return read_motor(source, plugin, robot);
  if (is_hector_propulsion(plugin)) {
    robot.has_hector_propulsion = true;
    return;
  }
  std::string library = read_attribute(plugin, "filename");
  std::transform(library.begin(), library.end(), library.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const KnownPlugin& known : kKnown) {
    if (has(library, known.in_name)) return known.read(source, plugin, robot);
  }
  const bool is_needless = std::any_of(kNeedless.begin(), kNeedless.end(),
                                       [&](std::string_view word) { return has(library, word); });
  if (is_needless) return;
  const std::string name = read_attribute(plugin, "name");
  robot.skipped.push_back(source.skipped(
      plugin, fmt::format("plugin {} ({})", name, read_attribute(plugin, "filename")),
      "has no counterpart"));
}

}  // namespace throng::imports
