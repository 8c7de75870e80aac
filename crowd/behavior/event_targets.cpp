#include <fmt/core.h>

#include "crowd/behavior/events.h"

namespace throng::crowd {

namespace {

/// The agents that are in a state, or that are not.
class StateMembers : public EventTarget {
 public:
  StateMembers(std::uint8_t state, bool members) : state_(state), members_(members) {}
  bool includes(const Crowd& crowd, std::size_t agent) const override {
    return (crowd.agents.state[agent] == state_) == members_;
  }

 private:
  std::uint8_t state_;
  bool members_;
};

class OneAgent : public EventTarget {
 public:
  explicit OneAgent(std::size_t agent) : agent_(agent) {}
  bool includes(const Crowd&, std::size_t agent) const override { return agent == agent_; }

 private:
  std::size_t agent_;
};

std::unique_ptr<EventTarget> make_state_members(const Element& element,
                                                const Attributes& attributes,
                                                BehaviorContext& context) {
  element.require_no_children();
  return std::make_unique<StateMembers>(
      context.require_state(element, "state", attributes.text("state")),
      attributes.boolean("is_member"));
}

std::unique_ptr<EventTarget> make_one_agent(const Element& element, const Attributes& attributes,
                                            BehaviorContext& context) {
  element.require_no_children();
  const auto agent = static_cast<std::size_t>(attributes.integer("id"));
  if (agent >= context.agent_count) {
    element.fail_attribute("id", fmt::format("{}", agent),
                           fmt::format("an agent's id, below {}", context.agent_count));
  }
  return std::make_unique<OneAgent>(agent);
}

}  // namespace

const EventTargetRegistry& event_target_registry() {
  static const EventTargetRegistry kRegistry(
      {{
          {"named_state_member",
           "who is in a state, or who is not",
           {text("state", "the name of a state"),
            boolean("is_member", "1: who is in it; 0: everybody else")},
           make_state_members},
          {"agent_id", "one agent", {integer("id", "of the agent", 0, kMaxId)}, make_one_agent},
      }},
      {text("name", "by which responses refer to it")});
  return kRegistry;
}

}  // namespace throng::crowd
