// From a trace to scenes: where everybody is and in which pose, at any time in any order.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "render/scene.h"
#include "skinning/animate/plan.h"
#include "skinning/population.h"
#include "world/trace.h"

namespace throng::render {

/// Plans each agent's motion along the trace. The trace and population must outlive it.
class Animator {
 public:
  Animator(const world::Trace& trace, const skinning::Population& population,
           const skinning::Styling& styling = {});

  /// The people at `time_s` (interpolated between crowd steps); agents that are not people,
  /// have not arrived yet or have left are left out.
  Scene scene_at(double time_s, std::int64_t frame_index) const;

  /// Actions at a crowd step at which the agent is present; none of agents that are not
  /// people.
  skinning::Actions actions_at(std::size_t agent, std::size_t step) const;

 private:
  /// From an agent's arrival to its departure.
  struct Stay {
    std::size_t first_step;
    skinning::MotionPlan plan;
  };
  const Stay& stay_at(std::size_t agent, std::size_t step) const;

  const world::Trace* trace_;
  std::vector<skinning::Appearance> appearance_;  ///< per agent
  std::vector<std::vector<Stay>> stays_;          ///< per agent, by time
};

}  // namespace throng::render
