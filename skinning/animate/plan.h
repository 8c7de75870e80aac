// Motion plan of an agent's body during its stay: a sequence of pieces of clips, each joined to the
// next in a frame that both share or by a blend from a frame of one to a frame of the other.
//
// Pieces of walking are driven by the distance walked, so that a foot that stands stays in its
// place at any speed; all others by time. Nothing ever jumps, and a moment's pose needs no earlier
// moment.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "skinning/animate/action.h"
#include "skinning/animate/motion.h"
#include "skinning/animate/trajectory.h"
#include "skinning/appearance.h"

namespace throng::skinning {

/// A piece of motion: from one position in a clip to another, or from a frame to a frame.
struct Piece {
  double begin = 0;  ///< step of the crowd at which it begins
  double from = 0;   ///< driver's value at its beginning: meters walked or steps
  double to = 0;     ///< and at its end
  double frame = 0;  ///< of the clip, or a palette
  double to_frame = 0;
  const Clip* clip = nullptr;  ///< null: blend between two palettes
  bool by_distance = false;
};

class MotionPlan {
 public:
  /// The plan of an agent with this appearance; `key` identifies run and agent. The population must
  /// outlive it.
  MotionPlan(const Population& population, const Appearance& appearance, std::uint64_t key,
             std::span<const Moment> moments, double dt_s);

  /// The pose at a step of the stay, fractions included; clamped to the stay.
  PoseBlend at(double step) const;

  /// Actions that the pose is part of. A blend of two motions is the second one.
  Actions actions_at(double step) const;

 private:
  std::vector<Piece>::const_iterator piece_at(double step) const;

  std::vector<Piece> pieces_;
  std::vector<float> distance_m_;
};

}  // namespace throng::skinning
