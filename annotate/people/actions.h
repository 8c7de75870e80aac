// Actions of people, per image and over a run, and members of social groups who are together.
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

/// Max distance between two members of a social group who are together (m).
inline constexpr double kTogetherM = 3;

/// Properties of a run's people on which their actions depend: carried objects and social groups.
class ActionFacts {
 public:
  /// The trace must outlive this object. `styling` must be that of the renderer.
  ActionFacts(const world::Trace& trace, const skinning::Population& population,
              const skinning::Styling& styling);

  /// Names of `actions`, the actions that the body's motion shows, and "carry" if the agent carries
  /// an object.
  std::vector<std::string_view> action_names(std::uint32_t agent, skinning::Actions actions) const;

  /// Members of the agent's group within kTogetherM of it. The agent must be present at the time
  /// `at`.
  std::vector<std::uint32_t> together_with(std::uint32_t agent,
                                           const world::BetweenSteps& at) const;

  const world::Trace& trace() const { return *trace_; }

 private:
  const world::Trace* trace_;
  std::vector<bool> carries_;                        ///< by agent
  std::vector<std::vector<std::uint32_t>> members_;  ///< by group
};

/// Sets the actions of all people in `labels`, the labels of a frame at this time.
void add_actions(const ActionFacts& facts, double time_s, FrameLabels& labels);

/// The content of actions/RUN.csv: `track_id,action,other,from_s,to_s`, one row per interval of an
/// action, whether a camera sees it or not, sorted by track and time. `other` is the track id of
/// the other person for the action "together", else empty. Interval ends are steps of the trace,
/// from the last step that is not after `from_s` to the first one that is not before `to_s`.
std::string actions_csv(const world::Trace& trace, const render::Animator& animator,
                        const ActionFacts& facts, double from_s, double to_s,
                        std::int64_t run_index);

}  // namespace throng::annotate
