// The downwash of a hovering vehicle.
#pragma once

#include "spec/sim/airframe.h"

namespace throng::sim {

inline constexpr double kAirDensity = 1.225;  ///< kg/m³, ISA at sea level

/// Induced speed (m/s) of the air through the rotor discs of a hovering vehicle (momentum theory):
/// v_h = sqrt(weight / (2 rho A)), with A the total area of the discs.
double hover_induced_mps(const Airframe& airframe);

/// The air jet below a hovering vehicle. The four wakes are modeled as one round jet with their
/// momentum. Its speed on the axis is 2 v_h at first and decays with the distance z as in a free
/// jet, by 6.2 D / z with D the diameter of the contracted wake; half of it remains at 0.094 z from
/// the axis (Rajaratnam 1976, Turbulent Jets, ch. 2). Wind does not deflect the jet.
class Jet {
 public:
  explicit Jet(const Airframe& airframe);

  /// Downward speed (m/s) at a point `below_m` below the rotors and `aside_m` from the vehicle's
  /// vertical axis; 0 above the rotors.
  double speed_mps(double below_m, double aside_m) const;

  /// A fast, conservative test: false only if the jet is negligible at the point.
  bool may_reach(double below_m, double aside_m) const {
    return below_m > 0 && aside_m < kEdge * (kHalfWidth * below_m + narrowest_m_);
  }

  /// Distance (m) below the rotors up to which the speed on the axis is at least `speed_mps` (> 0).
  double reach_m(double speed_mps) const;

 private:
  static constexpr double kHalfWidth = 0.094;  ///< half width of the jet per distance
  static constexpr double kEdge = 4;           ///< in half widths, where 2^-16 of the speed remains

  double start_mps_;
  double diameter_m_;
  double narrowest_m_;  ///< half width before the jet spreads
};

}  // namespace throng::sim
