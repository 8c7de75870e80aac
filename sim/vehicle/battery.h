// Power of flight, and state of charge of the battery.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sim/vehicle/quadcopter.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

/// Electric power (W) that a vehicle takes. Each rotor does the work of thrust times the air's
/// speed through its disc, which momentum theory gives (Glauert 1926; Leishman 2006, Principles of
/// Helicopter Aerodynamics, eq. 2.126): v_i = v_h² / sqrt(V_across² + (V_along + v_i)²). The
/// airframe's efficiency stands for what blades, motors and controllers lose.
double electric_power_w(const Airframe& airframe, double thrust_n,
                        const Eigen::Vector3d& velocity_through_air, const Eigen::Vector3d& up);

/// The same for a hover in still air.
double hover_power_w(const Airframe& airframe);
/// How long the vehicle can hover with a full battery; 0: its battery is not known.
double hover_endurance_s(const Airframe& airframe);

/// Counts the energy used. A battery without a charge never runs out.
class Battery {
 public:
  /// `charge` is the share of its capacity that it starts with.
  Battery(double capacity_wh, std::optional<double> charge);

  void use(double power_w, double dt_s) { used_j_ += power_w * dt_s; }
  double used_j() const { return used_j_; }
  /// Share of the capacity that is left; 1 for one that never runs out.
  double charge() const;

 private:
  double capacity_j_;
  std::optional<double> start_;
  double used_j_ = 0;
};

}  // namespace throng::sim
