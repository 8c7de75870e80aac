// The steps of a walk: which clip shows each, so that all of them together are exactly as long as
// the way.
#pragma once

#include <vector>

#include "skinning/animate/figure.h"
#include "skinning/animate/motion.h"
#include "skinning/animate/trajectory.h"

namespace throng::skinning {

/// The walking person.
struct Pedestrian {
  double stature_m = 1.75;
  double age_years = 35;
  double stride = 1;        ///< length of strides against the average person's
  double phase_offset = 0;  ///< where in a stride somebody is who is already walking, in [0, 1)
};

/// From where one foot stands below the body to where the other one does.
struct Footstep {
  const Clip* clip = nullptr;
  Side side = Side::left;  ///< that stands at the beginning
  double begin_m = 0;      ///< on the path
  double length_m = 0;     ///< half a stride
};

struct Walk {
  std::vector<Footstep> steps;  ///< empty when the path is too short for any
  bool from_rest = false;       ///< starts standing; else in the middle of a step
  bool to_rest = false;         ///< ends standing; else in the middle of a step
};

/// Plans the walk along a moving stretch. Strides are the natural ones for the speed at each step;
/// between two rests they are all a little longer or shorter so that the last one ends where the
/// path does. The remainder (a share of the difference between two clips) is spread over the walk.
Walk plan_walk(const Trajectory& trajectory, const Stretch& stretch, bool from_rest, bool to_rest,
               const ClipSet& clips, const Pedestrian& pedestrian);

}  // namespace throng::skinning
