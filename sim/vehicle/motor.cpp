#include "sim/vehicle/motor.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

double motor_torque_nm(const ElectricMotor& motor, double voltage_v, double speed_rad_s) {
  const double t =
      (voltage_v * motor.voltage_share - motor.flux_vs * speed_rad_s) / (2 * motor.resistance_ohm);
  const double idle_a2 = voltage_v * motor.idle_current_a / motor.resistance_ohm;
  return motor.flux_vs * (t + std::sqrt(t * t + idle_a2));
}

double axial_thrust_n(const Airframe& airframe, const ElectricMotor& motor, double speed_rad_s,
                      double inflow_mps) {
  const double thrust_n = airframe.thrust_n_s2 * speed_rad_s * speed_rad_s +
                          motor.inflow_n_s2_m * inflow_mps * speed_rad_s -
                          motor.inflow_n_s2_m2 * inflow_mps * std::abs(inflow_mps);
  return std::max(0.0, thrust_n);
}

// The equation of axial_thrust_n(), solved for the speed.
double speed_for_rad_s(const Airframe& airframe, double thrust_n, double inflow_mps) {
  if (!airframe.electric_motor) return std::sqrt(thrust_n / airframe.thrust_n_s2);
  const ElectricMotor& motor = *airframe.electric_motor;
  const double half = -0.5 * motor.inflow_n_s2_m * inflow_mps / airframe.thrust_n_s2;
  const double rest =
      (thrust_n + motor.inflow_n_s2_m2 * inflow_mps * std::abs(inflow_mps)) / airframe.thrust_n_s2;
  return std::max(0.0, half + std::sqrt(std::max(0.0, half * half + rest)));
}

// The equation of the current, I² - I (U b - Psi w) / R = U a / R, solved for U.
double voltage_for_v(const ElectricMotor& motor, double torque_nm, double speed_rad_s) {
  const double current_a = std::max(0.0, torque_nm / motor.flux_vs);
  const double numerator =
      current_a * (current_a * motor.resistance_ohm + motor.flux_vs * speed_rad_s);
  const double denominator = motor.idle_current_a + current_a * motor.voltage_share;
  if (!(denominator > 0)) return 0;
  return std::clamp(numerator / denominator, 0.0, motor.supply_v);
}

}  // namespace throng::sim
