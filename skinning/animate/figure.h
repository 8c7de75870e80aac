// A body as motion describes it: trunk and arms by how they are turned, legs by where the feet are.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "skinning/animate/reach.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// How somebody holds and moves themselves, whatever they do.
struct Manner {
  double age_years = 35;
  Carry carries = Carry::nothing;
  double arm_swing = 1;     ///< against the average, 0.6 to 1.4
  double lean_deg = 0;      ///< of the trunk, forwards, against the average
  double liveliness = 1;    ///< of hips, shoulders and swinging legs, 0.92 to 1.08
  double elbow_deg = 0;     ///< bend against the average
  double arms_out_deg = 0;  ///< from the body, against the average
  bool left_handed = false;
};

/// The manner of one person; names distinguish people.
Manner choose_manner(const Character& character);

/// Properties of a character that its motion depends on.
struct Walker {
  Joints joints;
  float stature_m = 0;
  std::vector<Vertex> soles;  ///< vertices of feet and toes; the lowest stands on the ground
  std::vector<Vertex> body;   ///< some vertices of body and clothes; the lowest lies on the ground
  Manner manner;
};

/// The walker of a character: soles are the vertices of its most detailed level that mostly hang on
/// feet and toes.
Walker make_walker(const Joints& joints, float stature_m, const Mesh& level);

enum class Side : std::uint8_t { left, right };
inline constexpr std::array<Side, 2> kSides = {Side::left, Side::right};

/// +1 on the left, where y is positive, and -1 on the right.
inline constexpr float side_sign(Side side) { return side == Side::left ? 1.0F : -1.0F; }
/// The bone of that side, given the left one.
inline constexpr Bone on(Side side, Bone left) {
  return side == Side::left ? left : static_cast<Bone>(static_cast<int>(left) + 4);
}

/// Position of a foot.
struct Foot {
  Eigen::Vector3f ankle = Eigen::Vector3f::Zero();
  double pitch_rad = 0;  ///< toes up against the heel
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

/// A foot that stands flat with its toe joint at `toe_x_m`, or rolls there: over the heel's edge
/// with its toes up, over the toe joint with its heel up. The pivot stays in place.
Foot standing_foot(const Walker& walker, Side side, double toe_x_m, double pitch_rad);

/// How high the sole's lowest point is above the ground.
double clearance_m(const Walker& walker, Side side, const Foot& foot);

Limb find_leg(const Walker& walker, Side side);

/// Hip joint of a leg in a figure, in model space.
Eigen::Vector3f hip_position(const Walker& walker, const Pose& pose, Side side);

/// From a to b: turned along the shortest arcs, feet in straight lines.
Figure mix(const Figure& a, const Figure& b, double share_of_b);
Pose mix(const Pose& a, const Pose& b, double share_of_b);

/// Bends the legs so that the feet are where the figure has them.
Pose solve(const Walker& walker, const Figure& figure);

/// The pose's palette, moved up or down so that the lowest of `touching` is on the ground.
Palette grounded(const Walker& walker, const Pose& pose, const std::vector<Vertex>& touching);

}  // namespace throng::skinning
