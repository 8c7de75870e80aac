// A piece of a motion plan.
#pragma once

#include "skinning/animate/motion.h"

namespace throng::skinning {

/// A piece of motion: between two positions in a clip, or a blend of two palettes.
struct Piece {
  double begin = 0;  ///< step of the stay at which it starts
  double from = 0;   ///< value of the driver at the start: walked distance (m) or steps
  double to = 0;     ///< value of the driver at the end
  double frame = 0;  ///< frame of the clip, or index of a palette, at the start
  double to_frame = 0;
  const Clip* clip = nullptr;  ///< null: blend between two palettes
  bool by_distance = false;
  float moving = 0;  ///< share of the piece in which it gets there, smoothly; 0: all of it, evenly
  float sway = 0;    ///< frames by which it sways about that, with no sway at its ends
};

}  // namespace throng::skinning
