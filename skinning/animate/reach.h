// Inverse kinematics of limbs with two bones: standing legs, holding arms.
#pragma once

#include <Eigen/Core>

namespace throng::skinning {

/// A limb of two bones at rest: the vectors from its root to the middle joint and from there to its
/// end (m), and the direction in which the middle joint bends.
struct Limb {
  Eigen::Vector3f upper;
  Eigen::Vector3f lower;
  Eigen::Vector3f bends_to;
};

/// The rotations of the two bones from rest.
struct LimbTurn {
  Eigen::Matrix3f upper;
  Eigen::Matrix3f lower;
};

/// Rotates the limb so that its end is at `target` (relative to its root), with the middle joint
/// toward `bends_to`. If the target is out of reach, the limb is extended toward it.
LimbTurn reach(const Limb& limb, const Eigen::Vector3f& target, const Eigen::Vector3f& bends_to);

/// Distance between the ends of a limb whose middle joint is bent by `bend_rad` (0: straight).
double chord_m(const Limb& limb, double bend_rad);

}  // namespace throng::skinning
