// Plans the steps of a walk and their clips, so that their total length equals the length of the
// path.
#pragma once

#include <string_view>
#include <vector>

#include "skinning/animate/figure.h"
#include "skinning/animate/motion.h"
#include "skinning/animate/trajectory.h"

namespace throng::skinning {

/// The walking person.
struct Pedestrian {
  double stature_m = 1.75;
  double age_years = 35;
  double stride = 1;               ///< length of strides relative to the average
  double phase_offset = 0;         ///< phase of a person who already walks at the start, in [0, 1)
  std::string_view walk = "walk";  ///< clips by which the person walks
  std::string_view flight = "panic";  ///< and runs in panic
};

/// A step: from the position at which one foot stands below the body to that of the other foot.
struct Footstep {
  const Clip* clip = nullptr;
  Side side = Side::left;  ///< standing foot at the start
  double begin_m = 0;      ///< distance on the path
  double length_m = 0;     ///< half a stride
};

/// The steps along a moving stretch.
struct Walk {
  std::vector<Footstep> steps;  ///< empty if the path is too short for a step
  bool from_rest = false;       ///< starts standing; else in the middle of a step
  bool to_rest = false;         ///< ends standing; else in the middle of a step
};

/// Plans the walk along a moving stretch. Strides have the natural length for the speed at each
/// step; between two rests they are scaled so that the last one ends at the end of the path. The
/// remainder (a share of the difference between two clips) is distributed over the walk.
Walk plan_walk(const Trajectory& trajectory, const Stretch& stretch, bool from_rest, bool to_rest,
               const ClipSet& clips, const Pedestrian& pedestrian);

}  // namespace throng::skinning
