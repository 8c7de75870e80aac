#include "crowd/behavior/events.h"
#include "crowd/behavior/machine.h"
#include "crowd/behavior/property_change.h"

namespace throng::crowd {

namespace {

class ChangeProperty : public EventEffect {
 public:
  explicit ChangeProperty(const PropertyChange& change) : change_(change) {}
  void apply(Crowd& crowd, Machine&, std::size_t agent) override {
    change_.apply(crowd, agent, draw_++);
  }

 private:
  PropertyChange change_;
  std::uint32_t draw_ = 0;
};

class ChangeState : public EventEffect {
 public:
  ChangeState(std::uint8_t state, bool reenter) : state_(state), reenter_(reenter) {}
  void apply(Crowd& crowd, Machine& machine, std::size_t agent) override {
    if (!reenter_ && crowd.agents.state[agent] == state_) return;
    machine.change_state(crowd, agent, state_);
  }

 private:
  std::uint8_t state_;
  bool reenter_;
};

template <Change kChange>
std::unique_ptr<EventEffect> make_property(const Element& element, const Attributes& attributes,
                                           BehaviorContext& context) {
  element.require_no_children();
  return std::make_unique<ChangeProperty>(
      PropertyChange::read(element, attributes, kChange, context));
}

std::unique_ptr<EventEffect> make_state(const Element& element, const std::string& name,
                                        bool reenter, BehaviorContext& context) {
  const std::uint8_t state =
      context.require_state(element, element.name() == "StateSelector" ? "name" : "state", name);
  context.states_from_outside.push_back(state);
  return std::make_unique<ChangeState>(state, reenter);
}

std::unique_ptr<EventEffect> make_change_state(const Element& element, const Attributes& attributes,
                                               BehaviorContext& context) {
  element.require_no_children();
  return make_state(element, attributes.text("state"), attributes.boolean("force_reentry"),
                    context);
}

std::unique_ptr<EventEffect> make_set_agent_state(const Element& element,
                                                  const Attributes& attributes,
                                                  BehaviorContext& context) {
  const Element selector = element.only_child("StateSelector");
  const Attributes choice(selector, {word("type", {"const"}, "how states are chosen"),
                                     text("name", "the name of a state")});
  return make_state(selector, choice.text("name"), attributes.boolean("reenter"), context);
}

AttributeTable reentry(std::string_view name) {
  return {optional(boolean(name, "1: also who is in it already enters it"), "0")};
}

AttributeTable state_and_reentry() {
  AttributeTable table = reentry("force_reentry");
  table.insert(table.begin(), text("state", "the name of a state"));
  return table;
}

}  // namespace

const EventEffectRegistry& event_effect_registry() {
  static const EventEffectRegistry kRegistry(
      {{
          {"set_agent_property", "sets a property", property_change_attributes(),
           make_property<Change::set>},
          {"offset_agent_property", "adds to a property", property_change_attributes(),
           make_property<Change::offset>},
          {"scale_agent_property", "multiplies a property", property_change_attributes(),
           make_property<Change::scale>},
          {"set_agent_state", "puts agents into the state that a <StateSelector> names",
           reentry("reenter"), make_set_agent_state},
          {"change_state", "puts agents into a state", state_and_reentry(), make_change_state},
      }},
      {text("name", "by which responses refer to it")});
  return kRegistry;
}

}  // namespace throng::crowd
