#include "annotate/people/actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include "annotate/people/coco.h"
#include "annotate/people/decimals.h"
#include "render/people/people_on_stands.h"
#include "skinning/items.h"
#include "spec/annotate/table_columns.h"

namespace throng::annotate {

namespace {

constexpr std::string_view kCarry = "carry";
constexpr std::string_view kTogether = "together";

/// An action, and with whom if with somebody: track id, or 0.
using Doing = std::pair<std::string_view, std::int64_t>;

/// A stretch of time in steps of the trace, both included.
struct ActionStretch {
  Doing doing;
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Puts the actions of one agent, step by step, together to stretches.
class StretchMaker {
 public:
  void add(std::size_t step, const std::vector<Doing>& doings) {
    for (const Doing& doing : doings) {
      const auto [open, is_new] = open_.try_emplace(doing, ActionStretch{doing, step, step});
      if (!is_new && open->second.last + 1 < step) {
        done_.push_back(open->second);
        open->second.first = step;
      }
      open->second.last = step;
    }
  }

  /// By time, then action.
  std::vector<ActionStretch> take() {
    for (const auto& [doing, stretch] : open_) done_.push_back(stretch);
    open_.clear();
    std::sort(done_.begin(), done_.end(), [](const ActionStretch& a, const ActionStretch& b) {
      return std::pair(a.first, a.doing) < std::pair(b.first, b.doing);
    });
    return std::move(done_);
  }

 private:
  std::map<Doing, ActionStretch> open_;
  std::vector<ActionStretch> done_;
};

}  // namespace

ActionFacts::ActionFacts(const world::Trace& trace, const skinning::Population& population,
                         const skinning::Styling& styling)
    : trace_(&trace) {
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    const auto number = static_cast<std::uint32_t>(agent);
    const skinning::Appearance appearance = skinning::sample_appearance(
        population, trace.header.seed, number, styling, render::find_spot(trace.header, agent));
    carries_.push_back(population.characters[appearance.character].carries !=
                       skinning::Carry::nothing);
    const std::int32_t group = agent < trace.header.group.size() ? trace.header.group[agent] : -1;
    if (group < 0) continue;
    if (members_.size() <= static_cast<std::size_t>(group)) {
      members_.resize(static_cast<std::size_t>(group) + 1);
    }
    members_[static_cast<std::size_t>(group)].push_back(number);
  }
}

std::vector<std::string_view> ActionFacts::action_names(std::uint32_t agent,
                                                        skinning::Actions actions) const {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < skinning::kActionCount; ++i) {
    if (actions.has(static_cast<skinning::Action>(i))) names.push_back(skinning::kActionNames[i]);
  }
  if (carries_.at(agent)) names.push_back(kCarry);
  return names;
}

std::vector<std::uint32_t> ActionFacts::together_with(std::uint32_t agent,
                                                      const world::BetweenSteps& at) const {
  std::vector<std::uint32_t> others;
  const auto& groups = trace_->header.group;
  const std::int32_t group = agent < groups.size() ? groups[agent] : -1;
  if (group < 0) return others;
  const Eigen::Vector2f here = trace_->position_at(at, agent);
  for (const std::uint32_t other : members_.at(static_cast<std::size_t>(group))) {
    if (other == agent || !trace_->present(at.before, other)) continue;
    const Eigen::Vector2f there = trace_->position_at(at, other);
    if ((there - here).norm() <= static_cast<float>(kTogetherM)) others.push_back(other);
  }
  return others;
}

void add_actions(const ActionFacts& facts, double time_s, FrameLabels& labels) {
  const world::BetweenSteps at = facts.trace().steps_around(time_s);
  for (PersonLabel& label : labels.people) {
    label.actions = ActionLabel{facts.action_names(label.agent, label.person.actions),
                                facts.together_with(label.agent, at)};
  }
}

std::string actions_csv(const world::Trace& trace, const render::Animator& animator,
                        const ActionFacts& facts, double from_s, double to_s,
                        std::int64_t run_index) {
  std::string text = fmt::format("{}\n", kActionColumns);
  if (trace.steps() == 0) return text;
  // Frames lie between steps, whose poses they show.
  const std::size_t first = trace.steps_around(from_s).before;
  const world::BetweenSteps end = trace.steps_around(to_s);
  const std::size_t last = end.share > 0 ? end.after : end.before;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    const auto number = static_cast<std::uint32_t>(agent);
    StretchMaker stretches;
    for (std::size_t step = first; step <= last; ++step) {
      if (!trace.present(step, agent)) continue;
      const skinning::Actions actions = animator.actions_at(agent, step);
      if (actions.empty()) continue;
      std::vector<Doing> doings;
      for (const std::string_view name : facts.action_names(number, actions)) {
        doings.emplace_back(name, 0);
      }
      for (const std::uint32_t other : facts.together_with(number, {step, step, 0})) {
        doings.emplace_back(kTogether, track_id(run_index, other));
      }
      stretches.add(step, doings);
    }
    for (const ActionStretch& stretch : stretches.take()) {
      const auto& [name, other] = stretch.doing;
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", track_id(run_index, number),
                     name, other == 0 ? "" : std::to_string(other),
                     rounded(trace.time_s[stretch.first], kTimeDecimals),
                     rounded(trace.time_s[stretch.last], kTimeDecimals));
    }
  }
  return text;
}

}  // namespace throng::annotate
