#include <algorithm>
#include <limits>

#include "crowd/behavior/panic.h"
#include "crowd/behavior/saved.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

enum class MaskChange { add, remove, set };

class ChangeObstacles : public Action {
 public:
  ChangeObstacles(MaskChange change, std::uint32_t operand, Saved<std::uint32_t> saved)
      : change_(change), operand_(operand), saved_(std::move(saved)) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    std::uint32_t& mask = crowd.agents.obstacle_mask[agent];
    saved_.save(agent, mask);
    switch (change_) {
      case MaskChange::add:
        mask |= operand_;
        break;
      case MaskChange::remove:
        mask &= ~operand_;
        break;
      case MaskChange::set:
        mask = operand_;
        break;
    }
  }

  void leave(Crowd& crowd, std::size_t agent) override {
    saved_.restore(agent, crowd.agents.obstacle_mask[agent]);
  }

 private:
  MaskChange change_;
  std::uint32_t operand_;
  Saved<std::uint32_t> saved_;
};

/// As Menge gives obstacle classes back: who leaves gets those that the agent with the lowest id
/// had, of those who are in the state.
class ChangeObstaclesAsMenge : public Action {
 public:
  ChangeObstaclesAsMenge(MaskChange change, std::uint32_t operand, std::size_t agent_count)
      : inner_(change, operand, {false, agent_count}),
        had_(agent_count),
        is_inside_(agent_count, 0) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    had_[agent] = crowd.agents.obstacle_mask[agent];
    is_inside_[agent] = 1;
    inner_.enter(crowd, agent);
  }

  void leave(Crowd& crowd, std::size_t agent) override {
    const auto lowest = std::find(is_inside_.begin(), is_inside_.end(), 1);
    if (lowest == is_inside_.end()) return;
    crowd.agents.obstacle_mask[agent] = had_[static_cast<std::size_t>(lowest - is_inside_.begin())];
    is_inside_[agent] = 0;
  }

 private:
  ChangeObstacles inner_;
  std::vector<std::uint32_t> had_;
  std::vector<std::uint8_t> is_inside_;
};

class Teleport : public Action {
 public:
  explicit Teleport(const Sampler2& place) : place_(place) {}
  void enter(Crowd& crowd, std::size_t agent) override {
    crowd.agents.position[agent] = place_(agent, crowd.agents.entry[agent]);
  }
  void leave(Crowd&, std::size_t) override {}

 private:
  Sampler2 place_;
};

template <MaskChange kChange>
std::unique_ptr<Action> make_mask_change(const Element&, const Attributes& attributes,
                                         BehaviorContext& context) {
  const auto operand = static_cast<std::uint32_t>(attributes.integer("operand"));
  const bool restore = attributes.boolean("exit_reset");
  if (restore && kChange != MaskChange::set && context.crowd.compat != Compat::none) {
    return std::make_unique<ChangeObstaclesAsMenge>(kChange, operand, context.agent_count);
  }
  return std::make_unique<ChangeObstacles>(kChange, operand,
                                           Saved<std::uint32_t>(restore, context.agent_count));
}

std::unique_ptr<Action> make_teleport(const Element&, const Attributes& attributes,
                                      BehaviorContext& context) {
  return std::make_unique<Teleport>(context.make_sampler(attributes.distribution_2()));
}

template <MaskChange kChange>
ActionRegistry::Entry mask_entry(std::string_view type, std::string_view help) {
  return {
      type,
      help,
      {integer("operand", "bits of obstacle classes", 0, std::numeric_limits<std::uint32_t>::max()),
       exit_reset_attribute()},
      make_mask_change<kChange>};
}

}  // namespace

AttributeSpec exit_reset_attribute() {
  return optional(boolean("exit_reset", "1: undone when the state is left"), "0");
}

std::vector<ActionRegistry::Entry> obstacle_actions() {
  return {
      mask_entry<MaskChange::add>("add_obstacle", "agents avoid obstacles of more classes"),
      mask_entry<MaskChange::remove>("remove_obstacle", "obstacles of fewer classes"),
      mask_entry<MaskChange::set>("set_obstacle", "obstacles of these classes"),
      {"teleport", "puts the agent elsewhere", {distribution_2("position in m")}, make_teleport},
  };
}

const ActionRegistry& action_registry() {
  static const ActionRegistry kRegistry({property_actions(), obstacle_actions(),
                                         late_obstacle_actions(), stress_actions(),
                                         presence_actions(), panic_actions()});
  return kRegistry;
}

}  // namespace throng::crowd
