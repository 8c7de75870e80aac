// The air that a vehicle blows down to stay up.
#pragma once

#include "spec/sim/airframe.h"

namespace throng::sim {

inline constexpr double kAirDensity = 1.225;  ///< kg/m³, ISA at sea level

/// Speed of the air that the rotors of a hovering vehicle draw through their discs (momentum
/// theory): v_h = sqrt(weight / (2 rho A)), A being all discs together.
double hover_induced_mps(const Airframe& airframe);

/// The air below a hovering vehicle. The four wakes count as one round jet of the vehicle's
/// momentum: 2 v_h at first, then falling with distance z as that of a free jet, 6.2 D / z with D
/// the diameter of the contracted wake, and spreading so that half of the middle's speed is found
/// 0.094 z aside (Rajaratnam 1976, Turbulent Jets, ch. 2). The wind is not seen to bend it.
class Jet {
 public:
  explicit Jet(const Airframe& airframe);

  /// Downward speed (m/s) at a point so far below the rotors and so far aside of the vehicle's
  /// middle; 0 above them.
  double speed_mps(double below_m, double aside_m) const;

  /// Whether anything of it could be felt there; cheap, and conservative: false only if nothing can
  /// be felt.
  bool may_reach(double below_m, double aside_m) const {
    return below_m > 0 && aside_m < kEdge * (kHalfWidth * below_m + narrowest_m_);
  }

  /// How far below the rotors the middle is still as fast as `speed_mps` (> 0).
  double reach_m(double speed_mps) const;

 private:
  static constexpr double kHalfWidth = 0.094;  ///< where half the speed is left, per distance
  static constexpr double kEdge = 4;           ///< half widths beyond which 2^-16 of it is left

  double start_mps_;
  double diameter_m_;
  double narrowest_m_;  ///< half width where the jet has not spread yet
};

}  // namespace throng::sim
