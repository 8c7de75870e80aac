// Poses of people during a live flight. render::Animator plans each walk from a complete trace;
// here, strides follow from the distance walked so far, because the future is not known.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "live/loop/moment.h"
#include "render/animator.h"
#include "render/people/people_on_stands.h"
#include "skinning/animate/motion.h"
#include "skinning/appearance.h"
#include "skinning/population.h"
#include "world/trace.h"

namespace throng::live {

/// Heights of a run's people with their shoes (m), per agent.
std::vector<double> statures_m(const world::TraceHeader& header,
                               const skinning::Population& population,
                               const skinning::Styling& styling);

/// Computes the poses of a run's people; call it with moments in the order of time.
class PosedPeople {
 public:
  /// Assigns characters to the people of a run; `stands` and `sitters` are the scenario's. The
  /// population must outlive this object.
  PosedPeople(const world::TraceHeader& header, std::uint64_t seed,
              const skinning::Population& population, const skinning::Styling& styling,
              std::span<const world::Stand> stands, std::span<const world::Sitter> sitters);

  /// The scene with people and hazards at a time within the moment's step.
  render::Scene scene_at(const Moment& moment, double time_s);

 private:
  skinning::PoseBlend pose_of(std::size_t agent, double meters, double speed_mps,
                              std::uint8_t flags, double time_s);
  skinning::PoseBlend pose_on_stand(std::size_t agent, skinning::StandPosture posture,
                                    double time_s);

  const skinning::Population& population_;
  skinning::ClipSet clips_;
  std::vector<world::AgentRole> roles_;
  std::vector<skinning::Appearance> looks_;  ///< per agent
  std::vector<double> fell_at_s_;            ///< per agent; negative: has not fallen
  /// Postures by state, and of those in such a state the last two and when they changed.
  std::vector<std::optional<skinning::StandPosture>> postures_;
  std::vector<skinning::PostureTime> on_stands_;  ///< per agent; since_s is a time of the run
  skinning::SpectatorPoses poses_on_stands_;
  render::StandFloors floors_;
};

}  // namespace throng::live
