// Poses of people whose future is not known. render::Animator plans each walk from its beginning to
// its end; here strides follow from the meters walked so far.
#pragma once

#include <vector>

#include "jobs/live/flight.h"
#include "render/animator.h"
#include "skinning/animate/motion.h"
#include "skinning/appearance.h"
#include "skinning/population.h"

namespace throng::live {

class PeopleInMotion {
 public:
  /// The people of a run. The population must outlive it.
  PeopleInMotion(const world::TraceHeader& header, std::uint64_t seed,
                 const skinning::Population& population, const skinning::Styling& styling);

  /// People and dangers at a time of the moment's step.
  render::Scene scene_at(const Moment& moment, double time_s);

 private:
  skinning::PoseBlend pose_of(std::size_t agent, double meters, double speed_mps,
                              std::uint8_t flags, double time_s);

  const skinning::Population& population_;
  skinning::ClipSet clips_;
  std::vector<world::AgentRole> roles_;
  std::vector<skinning::Appearance> looks_;  ///< per agent
  std::vector<double> fell_at_s_;            ///< per agent; negative: stands
};

}  // namespace throng::live
