// Changes of properties of agents by actions and events.
#pragma once

#include <string_view>

#include "crowd/state/behavior.h"

namespace throng::crowd {

enum class Change { set, offset, scale };

/// Returns the attributes `property` and the distribution of the operand.
AttributeTable property_change_attributes();

/// Returns the property with this name, one of changeable_properties().
Property property_named(std::string_view name);
/// Returns the names of all properties except max_neighbors, in the order of Property.
std::vector<std::string_view> changeable_properties();

/// Clamps `value` to the limits of the property.
float within_limits(Property property, float value);

/// Sets, offsets or scales a property with a sampled operand.
class PropertyChange {
 public:
  PropertyChange(Property property, Change change, const Sampler& operand)
      : property_(property), change_(change), operand_(operand) {}
  /// Throws InputError for an operand out of the limits of the property.
  static PropertyChange read(const Element& element, const Attributes& attributes, Change change,
                             BehaviorContext& context);

  Property property() const { return property_; }
  /// `draw` is the number of the sample for this agent.
  void apply(Crowd& crowd, std::size_t agent, std::uint32_t draw);

 private:
  Property property_;
  Change change_;
  Sampler operand_;
};

}  // namespace throng::crowd
