// Actions of people, in images and over a run, and members of groups who are together.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "annotate/people/labels.h"
#include "render/animator.h"
#include "skinning/population.h"
#include "world/trace.h"

namespace throng::annotate {

/// Members of a group are together up to this distance.
inline constexpr double kTogetherM = 3;

/// Facts that the actions of a run's people depend on: which agents carry something, and groups.
class ActionFacts {
 public:
  /// The trace and the population must outlive it; the styling is that of the renderer.
  ActionFacts(const world::Trace& trace, const skinning::Population& population,
              const skinning::Styling& styling);

  /// Names of what a body's motion shows, with "carry" if the person carries something.
  std::vector<std::string_view> action_names(std::uint32_t agent, skinning::Actions actions) const;

  /// Members of the agent's group who are within kTogetherM at a time of the trace, at which the
  /// agent is present.
  std::vector<std::uint32_t> together_with(std::uint32_t agent,
                                           const world::BetweenSteps& at) const;

  const world::Trace& trace() const { return *trace_; }

 private:
  const world::Trace* trace_;
  std::vector<bool> carries_;                        ///< by agent
  std::vector<std::vector<std::uint32_t>> members_;  ///< by group
};

/// Sets the actions of everybody in `labels`, which are those of a frame at this time.
void add_actions(const ActionFacts& facts, double time_s, FrameLabels& labels);

/// actions/RUN.csv: `track_id,action,other,from_s,to_s`, a row per stretch of time in which
/// somebody does something, seen or not, by track and time. `other` is the track id of whom they
/// are "together" with, and else empty. Times are steps of the trace, from the last one that is not
/// after from_s to the first one that is not before to_s.
std::string actions_csv(const world::Trace& trace, const render::Animator& animator,
                        const ActionFacts& facts, double from_s, double to_s,
                        std::int64_t run_index);

}  // namespace throng::annotate
