// Electric power of flight, and the state of charge of the battery.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sim/vehicle/quadcopter.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

/// Electric power (W) of a vehicle. `velocity_through_air` (m/s) and the unit vector `up` of the
/// rotor axes have the same frame. The ideal power is thrust times the air's speed through the
/// discs, by momentum theory (Glauert 1926; Leishman 2006, Principles of Helicopter Aerodynamics,
/// eq. 2.126): v_i = v_h² / sqrt(V_across² + (V_along + v_i)²). The airframe's efficiency covers
/// the losses of blades, motors and controllers.
double electric_power_w(const Airframe& airframe, double thrust_n,
                        const Eigen::Vector3d& velocity_through_air, const Eigen::Vector3d& up);

/// Electric power (W) of a hover in still air.
double hover_power_w(const Airframe& airframe);
/// Duration (s) of a hover with a full battery; 0 if the battery is unknown.
double hover_endurance_s(const Airframe& airframe);

/// Counts the energy used. A battery without an initial charge never runs out.
class Battery {
 public:
  /// `charge`: initial share of the capacity, which must then be above 0.
  Battery(double capacity_wh, std::optional<double> charge);

  void use(double power_w, double dt_s) { used_j_ += power_w * dt_s; }
  double used_j() const { return used_j_; }
  /// Remaining share of the capacity; 1 for a battery that never runs out.
  double charge() const;

 private:
  double capacity_j_;
  std::optional<double> start_;
  double used_j_ = 0;
};

}  // namespace throng::sim
