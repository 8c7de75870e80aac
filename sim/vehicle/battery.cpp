#include "sim/vehicle/battery.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/vehicle/downwash.h"

namespace throng::sim {

namespace {

constexpr double kJoulesPerWh = 3600;

// The speed that the rotors add to the air. Newton's method on v sqrt(across² + (along + v)²) = h²,
// which is monotone for v > -along; a fast descent, where the theory ends, counts as a slow one.
double induced_mps(double hover_mps, double across_mps, double along_mps) {
  const double along = std::max(along_mps, -0.5 * hover_mps);
  const double target = hover_mps * hover_mps;
  double v = hover_mps;
  for (int i = 0; i < 4; ++i) {
    const double through = along + v;
    const double length = std::hypot(across_mps, through);
    const double slope = length + v * through / length;
    v = std::max(v - (v * length - target) / slope, 0.05 * hover_mps);
  }
  return v;
}

}  // namespace

double electric_power_w(const Airframe& airframe, double thrust_n,
                        const Eigen::Vector3d& velocity_through_air, const Eigen::Vector3d& up) {
  if (thrust_n <= 0) return airframe.avionics_w;
  const double along_mps = velocity_through_air.dot(up);
  const double across_mps = (velocity_through_air - along_mps * up).norm();
  const double hover_mps = hover_induced_mps(airframe) * std::sqrt(thrust_n / airframe.weight_n());
  const double through_mps =
      std::max(0.0, along_mps + induced_mps(hover_mps, across_mps, along_mps));
  return airframe.avionics_w + thrust_n * through_mps / airframe.rotor_efficiency;
}

double hover_power_w(const Airframe& airframe) {
  return electric_power_w(airframe, airframe.weight_n(), Eigen::Vector3d::Zero(),
                          Eigen::Vector3d::UnitZ());
}

double hover_endurance_s(const Airframe& airframe) {
  return airframe.battery_wh * kJoulesPerWh / hover_power_w(airframe);
}

Battery::Battery(double capacity_wh, std::optional<double> charge)
    : capacity_j_(capacity_wh * kJoulesPerWh), start_(charge) {
  check(!charge || capacity_wh > 0, "a battery that may run out has a capacity");
}

double Battery::charge() const {
  return start_ ? std::max(0.0, *start_ - used_j_ / capacity_j_) : 1.0;
}

}  // namespace throng::sim
