// Parameters of a rotor that a direct-current motor turns.
#pragma once

namespace throng::sim {

/// A brushless motor behind its controller, as seen from direct current, and the propeller's thrust
/// in axial flow (Sendobry 2011 as in hector_quadrotor_model). At the voltage U and the speed w the
/// current is I = t + sqrt(t² + U a / R) with t = (U b - Psi w) / (2 R), the torque is Psi I, and
/// the load is (torque per thrust) * thrust + (friction) * w.
struct ElectricMotor {
  double flux_vs = 0;         ///< Psi: torque per current, N m / A
  double inertia_kg_m2 = 0;   ///< of rotor and propeller
  double resistance_ohm = 0;  ///< R
  double friction_nms = 0;    ///< torque per speed; below 0 where a fit over the propeller says so
  double idle_current_a = 0;  ///< a
  double voltage_share = 1;   ///< b: voltage at the coils over the commanded voltage
  double supply_v = 0;        ///< highest voltage
  double inflow_n_s2_m = 0;   ///< thrust per speed and per velocity along the axis; below 0
  double inflow_n_s2_m2 = 0;  ///< loss of thrust per square of the velocity along the axis
};

}  // namespace throng::sim
