#include "spec/sim/airframe_rules.h"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>

namespace throng::sim {

using fields::FieldLocation;
using nlohmann::json;

namespace {

// Less than this leaves nothing to steer with: 35 degrees of tilt alone take 1.22.
constexpr double kMinThrustToWeight = 1.4;

bool are_valid(std::initializer_list<const char*> fields, const FieldLocation& place) {
  return std::none_of(fields.begin(), fields.end(),
                      [&](const char* field) { return place.has_problem(field); });
}

/// Half the shortest distance between two axes.
double free_radius_m(const std::array<Rotor, 4>& rotors) {
  double distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      distance_m = std::min(distance_m, (rotors[i].at_m - rotors[j].at_m).norm());
    }
  }
  return 0.5 * distance_m;
}

/// Whether the rotors can turn the vehicle about all axes, one of which counts as 1 for a
/// well-placed quadcopter.
bool can_steer(const Airframe& frame) {
  const Eigen::Matrix4d mixing = rotor_mixing(frame);
  Eigen::Matrix4d scaled = mixing;
  scaled.row(1) /= frame.arm_m;
  scaled.row(2) /= frame.arm_m;
  scaled.row(3) /= frame.torque_per_thrust_m;
  constexpr double kMinDeterminant = 0.1;  // 8 in an X
  return std::abs(scaled.determinant()) > kMinDeterminant;
}

void check_rotors(const Airframe& frame, const json& value, const FieldLocation& place) {
  const double free_m = free_radius_m(frame.rotors);
  if (frame.propeller_radius_m > free_m) {
    place.below("propeller_radius_m")
        .reject(
            fmt::format("{:g}", frame.propeller_radius_m),
            fmt::format("at most {:.3g}, where the discs of rotors side by side touch", free_m));
  }
  if (!value.contains("rotors")) return;
  double max_distance_m = 0;
  for (const Rotor& rotor : frame.rotors) {
    max_distance_m = std::max(max_distance_m, rotor.at_m.norm());
  }
  constexpr double kRoundingM = 1e-3;
  if (std::abs(max_distance_m - frame.arm_m) > kRoundingM) {
    place.below("arm_m").reject(
        fmt::format("{:g}", frame.arm_m),
        fmt::format("{:.4g}, the distance of the farthest of the rotors", max_distance_m));
  }
  if (!can_steer(frame)) {
    place.below("rotors").reject("rotors that cannot turn the drone about all axes",
                                 "two that turn clockwise and two that turn counterclockwise, "
                                 "around the center");
  }
}

}  // namespace

void check_airframe(const Airframe& frame, const json& value, const FieldLocation& place) {
  if (!value.contains("electric_motor")) {
    for (const char* lag : {"motor_up_s", "motor_down_s"}) {
      if (value.contains(lag)) continue;
      place.reject(fmt::format("no \"{}\"", lag),
                   fmt::format("a \"{}\", or an \"electric_motor\"", lag));
    }
  }
  if (are_valid({"arm_m", "propeller_radius_m", "torque_per_thrust_m", "rotors"}, place)) {
    check_rotors(frame, value, place);
  }
  if (are_valid({"mass_kg", "thrust_n_s2", "max_rotor_rad_s", "autopilot/max_thrust_n"}, place) &&
      frame.max_thrust_n() < kMinThrustToWeight * frame.weight_n()) {
    place.reject(fmt::format("rotors that lift {:.3g} N at most, for a weight of {:.3g} N",
                             frame.max_thrust_n(), frame.weight_n()),
                 fmt::format("thrust of at least {} times the weight, to hover and steer",
                             kMinThrustToWeight));
  }
}

}  // namespace throng::sim
