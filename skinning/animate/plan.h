// The motion plan of an agent's body during its stay: a sequence of pieces of clips. Each piece is
// joined to the next by a common frame or by a blend between frames.
//
// Pieces of walking are driven by the walked distance, so that standing feet stay in place at any
// speed; all others are driven by time. Motion is continuous, and the pose at a time can be
// computed without earlier poses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "skinning/animate/action.h"
#include "skinning/animate/motion.h"
#include "skinning/animate/piece.h"
#include "skinning/animate/trajectory.h"
#include "skinning/appearance.h"

namespace throng::skinning {

/// The plan of one stay of an agent.
class MotionPlan {
 public:
  /// Plans the motion of an agent with this appearance; `key`, a seed, identifies run and agent.
  /// `moments` are the steps of the stay, `dt_s` apart. The population must outlive the plan.
  MotionPlan(const Population& population, const Appearance& appearance, std::uint64_t key,
             std::span<const Moment> moments, double dt_s);

  /// The pose at a step of the stay, possibly fractional; clamped to the stay.
  PoseBlend at(double step) const;

  /// The actions to which the pose belongs. A blend of two motions counts as the second one.
  Actions actions_at(double step) const;

 private:
  std::vector<Piece>::const_iterator piece_at(double step) const;

  std::vector<Piece> pieces_;
  std::vector<float> distance_m_;
  double dt_s_;
  double phase_;  ///< of swaying
};

}  // namespace throng::skinning
