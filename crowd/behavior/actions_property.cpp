#include "crowd/behavior/property_change.h"
#include "crowd/behavior/saved.h"

namespace throng::crowd {

namespace {

class ChangeProperty : public Action {
 public:
  ChangeProperty(const PropertyChange& change, Saved<float> saved)
      : change_(change), saved_(std::move(saved)) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    saved_.save(agent, crowd.agents[change_.property()][agent]);
    change_.apply(crowd, agent, crowd.agents.entry[agent]);
  }
  void leave(Crowd& crowd, std::size_t agent) override {
    saved_.restore(agent, crowd.agents[change_.property()][agent]);
  }

 private:
  PropertyChange change_;
  Saved<float> saved_;
};

/// A property that depends on where the agent enters the state.
class PropertyByX : public Action {
 public:
  struct Line {
    float origin = 0;  // m
    float value = 0;   // there
    float scale = 0;   // per m
  };

  PropertyByX(Property property, const Line& line, Saved<float> saved)
      : property_(property), line_(line), saved_(std::move(saved)) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    float& value = crowd.agents[property_][agent];
    saved_.save(agent, value);
    const float x = crowd.agents.position[agent].x();
    value = within_limits(property_, line_.value + line_.scale * (x - line_.origin));
  }
  void leave(Crowd& crowd, std::size_t agent) override {
    saved_.restore(agent, crowd.agents[property_][agent]);
  }

 private:
  Property property_;
  Line line_;
  Saved<float> saved_;
};

/// Grows with every entry, up to a limit (Huang 2016).
class Increment : public Action {
 public:
  Increment(Property property, float increment, float limit, Saved<float> saved)
      : property_(property), increment_(increment), limit_(limit), saved_(std::move(saved)) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    float& value = crowd.agents[property_][agent];
    saved_.save(agent, value);
    if (value < limit_) value = within_limits(property_, value + increment_);
  }
  void leave(Crowd& crowd, std::size_t agent) override {
    saved_.restore(agent, crowd.agents[property_][agent]);
  }

 private:
  Property property_;
  float increment_;
  float limit_;
  Saved<float> saved_;
};

template <Change kChange>
std::unique_ptr<Action> make_change(const Element& element, const Attributes& attributes,
                                    BehaviorContext& context) {
  return std::make_unique<ChangeProperty>(
      PropertyChange::read(element, attributes, kChange, context),
      Saved<float>(attributes.boolean("exit_reset"), context.agent_count));
}

std::unique_ptr<Action> make_by_x(const Element&, const Attributes& attributes,
                                  BehaviorContext& context) {
  return std::make_unique<PropertyByX>(
      property_named(attributes.text("property")),
      PropertyByX::Line{attributes.real("origin"), attributes.real("value"),
                        attributes.real("scale")},
      Saved<float>(attributes.boolean("exit_reset"), context.agent_count));
}

std::unique_ptr<Action> make_increment(const Element&, const Attributes& attributes,
                                       BehaviorContext& context) {
  // The paper's own action knew the radius only, and never undid anything.
  const bool as_huang = context.crowd.compat == Compat::huang2016;
  return std::make_unique<Increment>(
      as_huang ? Property::radius : property_named(attributes.text("property")),
      attributes.real("increment"), attributes.real("limit"),
      Saved<float>(!as_huang && attributes.boolean("exit_reset"), context.agent_count));
}

template <Change kChange>
ActionRegistry::Entry change_entry(std::string_view type, std::string_view help) {
  AttributeTable table = property_change_attributes();
  table.push_back(exit_reset_attribute());
  return {type, help, std::move(table), make_change<kChange>};
}

AttributeSpec property_attribute() {
  return word("property", changeable_properties(), "what it changes; max_angle_vel in radians/s");
}

}  // namespace

std::vector<ActionRegistry::Entry> property_actions() {
  return {
      change_entry<Change::set>("set_property", "sets a property of the agent"),
      change_entry<Change::offset>("offset_property", "adds to a property of the agent"),
      change_entry<Change::scale>("scale_property", "multiplies a property of the agent"),
      {"set_xproperty",
       "sets a property to value + scale (x - origin)",
       {property_attribute(), number("origin", "the x in m where it is `value`"),
        number("value", "of the property"), number("scale", "change per m"),
        exit_reset_attribute()},
       make_by_x},
      {"increment_property",
       "adds to a property that is below a limit",
       {optional(property_attribute(), "r"), number("increment", "what is added"),
        optional(number("limit", "from which on it does not grow"), "20"), exit_reset_attribute()},
       make_increment},
  };
}

}  // namespace throng::crowd
