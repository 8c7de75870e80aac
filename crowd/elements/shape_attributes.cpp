#include "crowd/elements/shape_attributes.h"

#include <fmt/core.h>

#include <cmath>

#include "crowd/agents/agents.h"

namespace throng::crowd {

AttributeTable box_attributes() {
  return {number("min_x", "left side in m"), number("min_y", "lower side in m"),
          number("max_x", "right side in m"), number("max_y", "upper side in m")};
}

Box read_box(const Element& element, const Attributes& attributes) {
  const Box box{{attributes.real("min_x"), attributes.real("min_y")},
                {attributes.real("max_x"), attributes.real("max_y")}};
  for (const auto& [axis, name] : {std::pair(0, "max_x"), std::pair(1, "max_y")}) {
    if (box.max[axis] < box.min[axis]) {
      element.fail_attribute(name, fmt::format("{}", box.max[axis]),
                             fmt::format("a number from {} (the minimum)", box.min[axis]));
    }
  }
  return box;
}

AttributeTable turned_box_attributes(std::string_view x, std::string_view y) {
  return {number(x, "the corner that it turns about, in m"),
          number(y, "the corner that it turns about, in m"),
          number("width", "along the turned x axis, in m", 0, kMaxCoordinate),
          number("height", "along the turned y axis, in m", 0, kMaxCoordinate),
          number("angle", "counter-clockwise turn in degrees", -3600, 3600)};
}

TurnedBox read_turned_box(const Attributes& attributes, std::string_view x, std::string_view y) {
  const float angle = attributes.real("angle") * kRadiansPerDegree;
  return {{attributes.real(x), attributes.real(y)},
          {attributes.real("width"), attributes.real("height")},
          {std::cos(angle), std::sin(angle)}};
}

AttributeTable circle_attributes(std::string_view x, std::string_view y) {
  return {number(x, "center in m"), number(y, "center in m"),
          number("radius", "in m", 0, kMaxCoordinate)};
}

Circle read_circle(const Attributes& attributes, std::string_view x, std::string_view y) {
  return {{attributes.real(x), attributes.real(y)}, attributes.real("radius")};
}

}  // namespace throng::crowd
