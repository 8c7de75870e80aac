#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "crowd/behavior.h"

namespace throng::crowd {

namespace {

/// Keeps what agents had, if it is to be given back when they leave the state.
template <typename Value>
class Saved {
 public:
  Saved(bool restore, std::size_t agent_count) : values_(restore ? agent_count : 0) {}
  void save(std::size_t agent, const Value& value) {
    if (!values_.empty()) values_[agent] = value;
  }
  void restore(std::size_t agent, Value& value) const {
    if (!values_.empty()) value = values_[agent];
  }

 private:
  std::vector<Value> values_;
};

enum class Change { set, offset, scale };

class ChangeProperty : public Action {
 public:
  ChangeProperty(Property property, Change change, const Sampler& operand, Saved<float> saved)
      : property_(property), change_(change), operand_(operand), saved_(std::move(saved)) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    float& value = crowd.agents[property_][agent];
    saved_.save(agent, value);
    const auto operand = static_cast<float>(operand_(agent, crowd.agents.entry[agent]));
    const PropertySpec& spec = spec_of(property_);
    value =
        std::clamp(changed(value, operand), spec.min * spec.file_unit, spec.max * spec.file_unit);
  }

  void leave(Crowd& crowd, std::size_t agent) override {
    saved_.restore(agent, crowd.agents[property_][agent]);
  }

 private:
  float changed(float value, float operand) const {
    switch (change_) {
      case Change::set:
        return operand;
      case Change::offset:
        return value + operand;
      case Change::scale:
        break;
    }
    return value * operand;
  }

  Property property_;
  Change change_;
  Sampler operand_;
  Saved<float> saved_;
};

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

/// max_neighbors is not among them: files cannot change it.
constexpr std::size_t kChangeable = kPropertyCount - 1;

std::vector<std::string_view> changeable_names() {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kChangeable; ++i) names.push_back(kProperties[i].name);
  return names;
}

Property property_named(std::string_view name) {
  std::size_t index = 0;
  while (kProperties[index].name != name) ++index;
  return static_cast<Property>(index);
}

AttributeSpec exit_reset() {
  return optional(boolean("exit_reset", "1: undone when the state is left"), "0");
}

template <Change kChange>
std::unique_ptr<Action> make_change(const Element& element, const Attributes& attributes,
                                    BehaviorContext& context) {
  const Distribution& operand = attributes.distribution("");
  const Property property = property_named(attributes.text("property"));
  const PropertySpec& spec = spec_of(property);
  const double low = spec.min * spec.file_unit;
  const double high = spec.max * spec.file_unit;
  if (kChange == Change::set && (operand.first < low || operand.first > high)) {
    element.fail(fmt::format("{} as {}", operand.first, spec.name),
                 fmt::format("a number from {:.6g} to {:.6g}", low, high));
  }
  return std::make_unique<ChangeProperty>(
      property, kChange, context.make_sampler(operand),
      Saved<float>(attributes.boolean("exit_reset"), context.agent_count));
}

template <MaskChange kChange>
std::unique_ptr<Action> make_mask_change(const Element&, const Attributes& attributes,
                                         BehaviorContext& context) {
  return std::make_unique<ChangeObstacles>(
      kChange, static_cast<std::uint32_t>(attributes.integer("operand")),
      Saved<std::uint32_t>(attributes.boolean("exit_reset"), context.agent_count));
}

std::unique_ptr<Action> make_teleport(const Element&, const Attributes& attributes,
                                      BehaviorContext& context) {
  return std::make_unique<Teleport>(context.make_sampler(attributes.distribution_2()));
}

template <Change kChange>
ActionRegistry::Entry change_entry(std::string_view type, std::string_view help) {
  return {type,
          help,
          {word("property", changeable_names(), "what it changes; max_angle_vel in radians/s"),
           distribution("", "the operand"), exit_reset()},
          make_change<kChange>};
}

template <MaskChange kChange>
ActionRegistry::Entry mask_entry(std::string_view type, std::string_view help) {
  return {
      type,
      help,
      {integer("operand", "bits of obstacle classes", 0, std::numeric_limits<std::uint32_t>::max()),
       exit_reset()},
      make_mask_change<kChange>};
}

}  // namespace

const ActionRegistry& action_registry() {
  static const ActionRegistry kRegistry({{
      change_entry<Change::set>("set_property", "sets a property of the agent"),
      change_entry<Change::offset>("offset_property", "adds to a property of the agent"),
      change_entry<Change::scale>("scale_property", "multiplies a property of the agent"),
      mask_entry<MaskChange::add>("add_obstacle", "obstacles of more classes are in the way"),
      mask_entry<MaskChange::remove>("remove_obstacle", "obstacles of fewer classes"),
      mask_entry<MaskChange::set>("set_obstacle", "obstacles of these classes"),
      {"teleport", "puts the agent elsewhere", {distribution_2("place in m")}, make_teleport},
  }});
  return kRegistry;
}

}  // namespace throng::crowd
