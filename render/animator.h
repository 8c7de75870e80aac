// From a trace to scenes: where everybody is and in which pose, at any time in any order.
#pragma once

#include <cstdint>

#include "render/renderer.h"
#include "skinning/population.h"
#include "world/trace.h"

namespace throng::render {

/// Precomputes each agent's stride phase along the trace. The trace and population must outlive it.
class Animator {
 public:
  Animator(const world::Trace& trace, const skinning::Population& population);

  /// The people at `time_s` (interpolated between crowd steps); agents that are not people,
  /// have not arrived yet or have left are left out.
  Scene scene_at(double time_s, std::int64_t frame_index) const;

 private:
  const world::Trace* trace_;
  const skinning::Population* population_;
  std::vector<skinning::Appearance> appearance_;  ///< per agent
  std::vector<double> phase_;                     ///< [agent][step], strides
};

}  // namespace throng::render
