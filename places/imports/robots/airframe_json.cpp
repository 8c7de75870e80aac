#include "places/imports/robots/airframe_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/text/suggest.h"
#include "places/imports/gazebo/camera_json.h"
#include "spec/job/spec.h"

namespace throng::imports {

using Eigen::Vector2d;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr std::size_t kRotors = 4;

/// Digits that a description gives, not those that sums add.
double significant(double value) {
  constexpr int kSignificant = 7;
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, kSignificant - 1 - std::floor(std::log10(std::abs(value))));
  return std::round(value * unit) / unit;
}

ordered_json number_list(const Eigen::Ref<const Eigen::VectorXd>& values) {
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(significant(value));
  return list;
}

class AirframeMaker {
 public:
  AirframeMaker(const Robot& robot, const std::string& file, const AirframeChoices& choices,
                std::vector<std::string>& assumptions)
      : robot_(robot), file_(file), choices_(choices), assumptions_(assumptions) {
    if (choices.base) base_ = sim::to_json(*choices.base);
  }

  ordered_json make() {
    frame_["source"] = fmt::format("Imported from {} (robot {}).",
                                   std::filesystem::path(file_).filename().string(), robot_.name);
    frame_["mass_kg"] = significant(robot_.mass_kg);
    add_rotors();
    require_plausible_inertia();
    frame_["inertia_kg_m2"] = number_list(robot_.inertia.diagonal());
    add_height();
    add_drag();
    if (robot_.battery_wh) frame_["battery_wh"] = significant(*robot_.battery_wh);
    for (const char* name : {"turn_drag_nm_s2", "rotor_efficiency", "avionics_w", "battery_wh",
                             "propeller_limit_mps", "structure_limit_mps", "autopilot"}) {
      if (!frame_.contains(name) && base_.contains(name)) frame_[name] = base_[name];
    }
    add_sensors();
    add_camera();
    reject_what_cannot_fly();
    return std::move(frame_);
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError({file_, "", found, expected});
  }

  void assume(const std::string& field, const std::string& why) {
    assumptions_.push_back(fmt::format("{}: {}", field, why));
  }

  void add_rotors() {
    if (robot_.rotors.empty()) return add_rotors_of_base();
    if (robot_.rotors.size() != kRotors) {
      refuse(fmt::format("{} rotors", robot_.rotors.size()), "a quadcopter's four");
    }
    require_equal_rotors();
    require_upright_rotors();
    const RobotRotor& rotor = robot_.rotors.front();
    ordered_json rotors = ordered_json::array();
    double arm_m = 0;
    for (const RobotRotor& each : robot_.rotors) {
      const Vector2d at = (each.position - robot_.center).head<2>();
      arm_m = std::max(arm_m, at.norm());
      rotors.push_back({{"at_m", number_list(at)},
                        {"turns", each.sense < 0 ? "clockwise" : "counterclockwise"}});
    }
    frame_["arm_m"] = significant(arm_m);
    frame_["rotors"] = std::move(rotors);
    add_propeller(rotor);
    frame_["thrust_n_s2"] = rotor.thrust_n_s2;
    frame_["torque_per_thrust_m"] = rotor.torque_per_thrust_m;
    frame_["max_rotor_rad_s"] = rotor.max_rad_s;
    frame_["motor_up_s"] = rotor.up_s;
    frame_["motor_down_s"] = rotor.down_s;
    frame_["rotor_drag_n_s2_m"] = rotor.drag_n_s2_m;
  }

  void add_rotors_of_base() {
    if (!choices_.base) {
      refuse("no rotors: no plugin with a <motorConstant>",
             "the plugins of its motors, or --base AIRFRAME, whose rotors it has");
    }
    for (const char* name :
         {"arm_m", "rotors", "propeller_radius_m", "thrust_n_s2", "torque_per_thrust_m",
          "max_rotor_rad_s", "motor_up_s", "motor_down_s", "electric_motor", "rotor_drag_n_s2_m"}) {
      if (base_.contains(name)) frame_[name] = base_[name];
    }
    assume("rotors", fmt::format("those of the airframe {}", choices_.base->name));
  }

  void require_equal_rotors() const {
    const RobotRotor& first = robot_.rotors.front();
    const auto differ = [](double a, double b) { return std::abs(a - b) > 0.01 * std::abs(a); };
    for (const RobotRotor& rotor : robot_.rotors) {
      if (differ(first.thrust_n_s2, rotor.thrust_n_s2) ||
          differ(first.torque_per_thrust_m, rotor.torque_per_thrust_m) ||
          differ(first.max_rad_s, rotor.max_rad_s) || differ(first.up_s, rotor.up_s) ||
          differ(first.down_s, rotor.down_s)) {
        refuse(fmt::format("other constants for {} than for {}", rotor.name, first.name),
               "four equal rotors");
      }
    }
  }

  void require_upright_rotors() const {
    const double min_upright_cosine = std::cos(5 * kDegree);
    for (const RobotRotor& rotor : robot_.rotors) {
      if (rotor.axis.z() < min_upright_cosine) {
        refuse(fmt::format("{}, which is tilted by {:.0f} degrees", rotor.name,
                           std::acos(std::clamp(rotor.axis.z(), -1.0, 1.0)) / kDegree),
               "rotors whose axes point up, within 5 degrees");
      }
    }
  }

  /// All of the mass within the propellers' reach has less than this; wrong units have more.
  void require_plausible_inertia() const {
    const double reach_m =
        2 * (frame_["arm_m"].get<double>() + frame_["propeller_radius_m"].get<double>());
    const double radius_m = std::sqrt(robot_.inertia.diagonal().maxCoeff() / robot_.mass_kg);
    if (radius_m > reach_m) {
      refuse(fmt::format("moments of inertia of {:.3g} kg m², as if all mass lay {:.2g} m away",
                         robot_.inertia.diagonal().maxCoeff(), radius_m),
             fmt::format("those of a body that reaches {:.2g} m, in kg m²", reach_m));
    }
  }

  void add_propeller(const RobotRotor& rotor) {
    double free_m = std::numeric_limits<double>::infinity();
    for (const RobotRotor& a : robot_.rotors) {
      for (const RobotRotor& b : robot_.rotors) {
        if (&a != &b) free_m = std::min(free_m, 0.5 * (a.position - b.position).head<2>().norm());
      }
    }
    constexpr double kUsualShare = 0.8;  // of the room between the axes
    if (rotor.radius_m) {
      frame_["propeller_radius_m"] = significant(std::min(*rotor.radius_m, free_m));
      return;
    }
    frame_["propeller_radius_m"] = significant(kUsualShare * free_m);
    assume("propeller_radius_m", fmt::format("{:.3g}, for {} has no box or cylinder as its shape",
                                             kUsualShare * free_m, rotor.name));
  }

  void add_height() {
    constexpr double kUsualM = 0.1;
    constexpr double kMinM = 0.01;
    if (robot_.height_m && *robot_.height_m >= kMinM) {
      frame_["height_m"] = significant(*robot_.height_m);
      return;
    }
    frame_["height_m"] = base_.contains("height_m") ? base_["height_m"] : json(kUsualM);
    assume("height_m", fmt::format("{:g}, for no box, cylinder or sphere of the body collides",
                                   frame_["height_m"].get<double>()));
  }

  void add_drag() {
    if (base_.contains("body_drag_n_s2_m2")) {
      frame_["body_drag_n_s2_m2"] = base_["body_drag_n_s2_m2"];
      assume("body_drag_n_s2_m2", fmt::format("that of the airframe {}", choices_.base->name));
      return;
    }
    frame_["body_drag_n_s2_m2"] = 0;
    assume("body_drag_n_s2_m2", "0, as in Gazebo; only the rotors drag");
  }

  void add_sensors() {
    const RobotSensors& sensors = robot_.sensors;
    ordered_json errors =
        base_.contains("sensors") ? ordered_json(base_["sensors"]) : ordered_json::object();
    const auto inertial = [&](const char* name, const std::optional<RobotInertialNoise>& noise) {
      if (!noise) return;
      errors[name] = {{"density", number_list(noise->density)},
                      {"walk", noise->walk},
                      {"turn_on", noise->turn_on}};
      if (noise->walk_s) errors[name]["walk_s"] = *noise->walk_s;
    };
    const auto number = [&](const char* name, const std::optional<double>& value) {
      if (value) errors[name] = significant(*value);
    };
    inertial("gyroscope", sensors.gyroscope);
    inertial("accelerometer", sensors.accelerometer);
    number("gps_hz", sensors.gps_hz);
    number("gps_white_m", sensors.gps_white_m);
    if (sensors.gps_wander_m) errors["gps_wander_m"] = number_list(*sensors.gps_wander_m);
    if (sensors.gps_velocity_mps)
      errors["gps_velocity_mps"] = number_list(*sensors.gps_velocity_mps);
    number("pressure_pa", sensors.pressure_pa);
    number("pressure_offset_pa", sensors.pressure_offset_pa);
    if (sensors.pressure_pa) errors["weather_share"] = 0;
    number("field_share", sensors.field_share);
    if (!errors.empty()) frame_["sensors"] = std::move(errors);
  }

  void add_camera() {
    const CameraSensor* chosen = nullptr;
    std::vector<std::string_view> names;
    for (const CameraSensor& camera : robot_.cameras) {
      names.emplace_back(camera.name);
      const bool fits = choices_.camera.empty() ? camera.is_color : camera.name == choices_.camera;
      if (fits && chosen == nullptr) chosen = &camera;
    }
    if (!choices_.camera.empty() && chosen == nullptr) {
      throw InputError(unknown_name(file_, "--camera", "camera", choices_.camera, names));
    }
    if (chosen == nullptr && !robot_.cameras.empty()) chosen = &robot_.cameras.front();
    if (chosen == nullptr) return;
    for (const CameraSensor& other : robot_.cameras) {
      if (&other == chosen) continue;
      assumptions_.push_back(
          fmt::format("camera: {}; {} is another one (--camera)", chosen->name, other.name));
    }
    frame_["camera"] = camera_json(*chosen, robot_.center, assumptions_);
  }

  /// Reads the airframe as a job's, which names each field that is out of range.
  void reject_what_cannot_fly() const {
    constexpr std::string_view kPointer = "/drones/0/airframe";
    const json job = {{"scenario", "city_square/everyday"},
                      {"drones", json::array({{{"id", "d1"}, {"airframe", frame_}}})}};
    try {
      jobs::check_and_read_job(job, file_);
    } catch (const InputError& error) {
      std::vector<Problem> problems = error.problems();
      for (Problem& problem : problems) {
        if (problem.where.starts_with(kPointer)) problem.where.erase(0, kPointer.size());
        problem.where = "airframe" + problem.where;
      }
      throw InputError(std::move(problems));
    }
  }

  const Robot& robot_;
  const std::string& file_;
  const AirframeChoices& choices_;
  std::vector<std::string>& assumptions_;
  json base_ = json::object();
  ordered_json frame_;
};

}  // namespace

ordered_json airframe_json(const Robot& robot, const std::string& file,
                           const AirframeChoices& choices, std::vector<std::string>& assumptions) {
  AirframeChoices completed = choices;
  if (!completed.base && robot.has_hector_propulsion) completed.base = sim::find_airframe("hector");
  return AirframeMaker(robot, file, completed, assumptions).make();
}

}  // namespace throng::imports
