#include "crowd/behavior/property_change.h"

#include <fmt/core.h>

#include <algorithm>

namespace throng::crowd {

namespace {

/// max_neighbors is not among them: files cannot change it.
constexpr std::size_t kChangeable = kPropertyCount - 1;

float changed(float value, Change change, float operand) {
  switch (change) {
    case Change::set:
      return operand;
    case Change::offset:
      return value + operand;
    case Change::scale:
      break;
  }
  return value * operand;
}

}  // namespace

std::vector<std::string_view> changeable_properties() {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kChangeable; ++i) names.push_back(kProperties[i].name);
  return names;
}

Property property_named(std::string_view name) {
  std::size_t index = 0;
  while (kProperties[index].name != name) ++index;
  return static_cast<Property>(index);
}

float within_limits(Property property, float value) {
  const PropertySpec& spec = property_spec(property);
  return std::clamp(value, spec.min * spec.file_unit, spec.max * spec.file_unit);
}

AttributeTable property_change_attributes() {
  return {word("property", changeable_properties(), "what it changes; max_angle_vel in radians/s"),
          distribution("", "the operand")};
}

PropertyChange PropertyChange::read(const Element& element, const Attributes& attributes,
                                    Change change, BehaviorContext& context) {
  const Distribution& operand = attributes.distribution("");
  const Property property = property_named(attributes.text("property"));
  const PropertySpec& spec = property_spec(property);
  const double low = spec.min * spec.file_unit;
  const double high = spec.max * spec.file_unit;
  if (change == Change::set && (operand.first < low || operand.first > high)) {
    element.fail(fmt::format("{} as {}", operand.first, spec.name),
                 fmt::format("a number from {:.6g} to {:.6g}", low, high));
  }
  return {property, change, context.make_sampler(operand)};
}

void PropertyChange::apply(Crowd& crowd, std::size_t agent, std::uint32_t draw) {
  float& value = crowd.agents[property_][agent];
  value =
      within_limits(property_, changed(value, change_, static_cast<float>(operand_(agent, draw))));
}

}  // namespace throng::crowd
