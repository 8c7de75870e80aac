// The description of a body in motion: trunk and arms by rotations, legs by the positions of the
// feet.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "skinning/animate/reach.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// A person's individual way of holding and moving the body.
struct Manner {
  double age_years = 35;
  Carry carries = Carry::nothing;
  double arm_swing = 1;     ///< relative to the average, 0.6 to 1.4
  double lean_deg = 0;      ///< additional forward lean of the trunk
  double liveliness = 1;    ///< amplitude of hips, shoulders and swinging legs, 0.92 to 1.08
  double elbow_deg = 0;     ///< additional bend of the elbows
  double arms_out_deg = 0;  ///< additional angle between arms and body
  bool left_handed = false;
};

/// The manner of a character, sampled by its name.
Manner choose_manner(const Character& character);

/// Properties of a character that its motion depends on.
struct Walker {
  Joints joints;
  float stature_m = 0;
  std::vector<Vertex> soles;  ///< vertices of feet and toes; the lowest one is on the ground
  /// Some vertices of body and clothes; when lying, the lowest one is on the ground.
  std::vector<Vertex> body;
  Manner manner;
};

/// The walker of a character. `level` is its most detailed mesh; soles are the vertices that move
/// mostly with feet and toes.
Walker make_walker(const Joints& joints, float stature_m, const Mesh& level);

enum class Side : std::uint8_t { left, right };
inline constexpr std::array<Side, 2> kSides = {Side::left, Side::right};

/// +1 on the left, where y is positive, and -1 on the right.
inline constexpr float side_sign(Side side) { return side == Side::left ? 1.0F : -1.0F; }
/// The bone on this side that corresponds to a left bone.
inline constexpr Bone on(Side side, Bone left) {
  return side == Side::left ? left : static_cast<Bone>(static_cast<int>(left) + 4);
}

/// Position of a foot.
struct Foot {
  Eigen::Vector3f ankle = Eigen::Vector3f::Zero();
  double pitch_rad = 0;  ///< positive: toes above the heel
  double toes_rad = 0;   ///< pitch of the toes
  double yaw_rad = 0;    ///< to the left
};

/// Pose without legs, and both feet.
struct Figure {
  Pose pose;
  std::array<Foot, 2> feet;

  Foot& of(Side side) { return feet[static_cast<std::size_t>(side)]; }
  const Foot& of(Side side) const { return feet[static_cast<std::size_t>(side)]; }
};

/// A foot on the ground with its toe joint at `toe_x_m` if flat. It rolls by `pitch_rad` over the
/// heel (toes up) or over the toe joint (heel up); the pivot stays in place.
Foot standing_foot(const Walker& walker, Side side, double toe_x_m, double pitch_rad);

/// Height of the sole's lowest point above the ground.
double clearance_m(const Walker& walker, Side side, const Foot& foot);

Limb find_leg(const Walker& walker, Side side);

/// Hip joint of a leg in a figure, in model space.
Eigen::Vector3f hip_position(const Walker& walker, const Pose& pose, Side side);

/// Interpolates between a (0) and b (1): rotations along the shortest arcs, feet linearly.
Figure mix(const Figure& a, const Figure& b, double share_of_b);
Pose mix(const Pose& a, const Pose& b, double share_of_b);

/// Solves for the legs so that the feet have the positions of the figure.
Pose solve(const Walker& walker, const Figure& figure);

/// The palette of a pose, translated vertically so that the lowest vertex of `touching` is on the
/// ground.
Palette grounded(const Walker& walker, const Pose& pose, const std::vector<Vertex>& touching);

}  // namespace throng::skinning
