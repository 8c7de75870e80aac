// Changing a property of an agent, as actions and events do.
#pragma once

#include <string_view>

#include "crowd/behavior.h"

namespace throng::crowd {

enum class Change { set, offset, scale };

/// `property` and the distribution of the operand.
AttributeTable property_change_attributes();

/// The property of this name, which is one of changeable_properties().
Property property_named(std::string_view name);
/// All but max_neighbors, in the order of Property.
std::vector<std::string_view> changeable_properties();

/// `value` within the property's limits.
float within_limits(Property property, float value);

class PropertyChange {
 public:
  PropertyChange(Property property, Change change, const Sampler& operand)
      : property_(property), change_(change), operand_(operand) {}
  /// Throws InputError for an operand that the property cannot be set to.
  static PropertyChange read(const Element& element, const Attributes& attributes, Change change,
                             BehaviorContext& context);

  Property property() const { return property_; }
  /// `draw` is the number of the draw among those for this agent.
  void apply(Crowd& crowd, std::size_t agent, std::uint32_t draw);

 private:
  Property property_;
  Change change_;
  Sampler operand_;
};

}  // namespace throng::crowd
