// Converts a trace to scenes: positions and poses of all people at any time, in any order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "render/people/people_on_stands.h"
#include "render/props/scene.h"
#include "skinning/animate/plan.h"
#include "skinning/population.h"
#include "world/trace.h"

namespace throng::render {

/// Plans each agent's motion along the trace. The trace and the population must outlive this
/// object.
class Animator {
 public:
  /// People on `stands` and `sitters`, which are copied, are as high as the floor there.
  Animator(const world::Trace& trace, const skinning::Population& population,
           const skinning::Styling& styling = {}, std::span<const world::Stand> stands = {},
           std::span<const world::Sitter> sitters = {});

  /// The scene at `time_s`, interpolated between steps of the crowd. It contains the people who are
  /// present. `frame_index` becomes Scene::index.
  Scene scene_at(double time_s, std::int64_t frame_index) const;

  /// The actions of an agent, which must be present, at a step of the crowd; none for agents that
  /// are not people.
  skinning::Actions actions_at(std::size_t agent, std::size_t step) const;

 private:
  /// An agent's presence from an arrival to the next departure.
  struct Stay {
    std::size_t first_step;
    skinning::MotionPlan plan;
  };
  const Stay& stay_at(std::size_t agent, std::size_t step) const;
  void pose(std::size_t agent, const world::BetweenSteps& at, double time_s,
            PersonInstance& person) const;

  const world::Trace* trace_;
  std::vector<skinning::Appearance> appearance_;  ///< per agent
  std::vector<std::vector<Stay>> stays_;          ///< per agent, in order of time
  PeopleOnStands on_stands_;
  skinning::SpectatorPoses poses_on_stands_;
};

}  // namespace throng::render
