// The equation of an electric motor with its propeller.
#pragma once

#include "spec/sim/airframe.h"

namespace throng::sim {

/// Torque (N m) of the motor at a voltage and a speed.
double motor_torque_nm(const ElectricMotor& motor, double voltage_v, double speed_rad_s);

/// Thrust (N), at least 0, of a rotor that moves along its axis with `inflow_mps` through the air.
double axial_thrust_n(const Airframe& airframe, const ElectricMotor& motor, double speed_rad_s,
                      double inflow_mps);

/// Speed (rad/s) at which a rotor has this thrust, for any motor. Only an electric motor's figures
/// say what its motion along the axis does.
double speed_for_rad_s(const Airframe& airframe, double thrust_n, double inflow_mps);

/// Voltage (V), at most that of the supply, at which the motor has this torque at this speed.
double voltage_for_v(const ElectricMotor& motor, double torque_nm, double speed_rad_s);

}  // namespace throng::sim
