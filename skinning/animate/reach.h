// Two bones that reach for a point: legs that stand, arms that hold.
#pragma once

#include <Eigen/Core>

namespace throng::skinning {

/// A limb of two bones as it is at rest: from its root to the middle joint, from there to its end,
/// and the side to which the middle joint bends.
struct Limb {
  Eigen::Vector3f upper;
  Eigen::Vector3f lower;
  Eigen::Vector3f bends_to;
};

/// How its two bones are turned against rest.
struct LimbTurn {
  Eigen::Matrix3f upper;
  Eigen::Matrix3f lower;
};

/// Turns the limb so that its end comes to `target` (from its root) with the middle joint toward
/// `bends_to`. A target out of reach is approached as far as the limb goes.
LimbTurn reach(const Limb& limb, const Eigen::Vector3f& target, const Eigen::Vector3f& bends_to);

/// Distance between the ends of a limb whose middle joint is bent by `bend_rad` from straight.
double chord_m(const Limb& limb, double bend_rad);

}  // namespace throng::skinning
