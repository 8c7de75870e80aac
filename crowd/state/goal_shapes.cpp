#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "crowd/elements/shape_attributes.h"
#include "crowd/state/goals.h"

namespace throng::crowd {

namespace {

class PointGoal : public GoalShape {
 public:
  explicit PointGoal(const Eigen::Vector2f& point) : point_(point) {}
  Eigen::Vector2f center() const override { return point_; }
  void move_to(const Eigen::Vector2f& center) override { point_ = center; }
  Eigen::Vector2f nearest_point(const Eigen::Vector2f&, float) const override { return point_; }

 private:
  Eigen::Vector2f point_;
};

class CircleGoal : public GoalShape {
 public:
  explicit CircleGoal(const Circle& circle) : circle_(circle) {}
  Eigen::Vector2f center() const override { return circle_.center; }
  void move_to(const Eigen::Vector2f& center) override { circle_.center = center; }
  Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const override {
    return circle_.nearest_point(p, margin);
  }
  float menge_distance(const Eigen::Vector2f& p) const override {
    return std::abs((p - circle_.center).norm() - circle_.radius);
  }

 private:
  Circle circle_;
};

class BoxGoal : public GoalShape {
 public:
  explicit BoxGoal(const Box& box) : box_(box) {}
  Eigen::Vector2f center() const override { return box_.center(); }
  void move_to(const Eigen::Vector2f& center) override {
    const Eigen::Vector2f half = 0.5F * (box_.max - box_.min);
    box_ = {center - half, center + half};
  }
  Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const override {
    return box_.nearest_point(p, margin);
  }
  float menge_distance(const Eigen::Vector2f& p) const override {
    if (box_.contains(p)) return 0;
    Eigen::Vector2f nearest = box_.nearest_point(p, 0);
    for (int axis = 0; axis < 2; ++axis) {
      if (p[axis] >= box_.min[axis] && p[axis] <= box_.max[axis]) nearest[axis] = 0;
    }
    return (nearest - p).norm();
  }

 private:
  Box box_;
};

class TurnedBoxGoal : public GoalShape {
 public:
  explicit TurnedBoxGoal(const TurnedBox& box) : box_(box) {}
  Eigen::Vector2f center() const override { return box_.to_world(box_.box().center()); }
  void move_to(const Eigen::Vector2f& center) override { box_.pivot += center - this->center(); }
  Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const override {
    return box_.contains(p) && margin == 0
               ? p
               : box_.to_world(box_.box().nearest_point(box_.to_box(p), margin));
  }

 private:
  TurnedBox box_;
};

std::unique_ptr<GoalShape> make_point(const Element&, const Attributes& attributes, GoalContext&) {
  return std::make_unique<PointGoal>(Eigen::Vector2f(attributes.real("x"), attributes.real("y")));
}

std::unique_ptr<GoalShape> make_circle(const Element&, const Attributes& attributes, GoalContext&) {
  return std::make_unique<CircleGoal>(read_circle(attributes, "x", "y"));
}

std::unique_ptr<GoalShape> make_box(const Element& element, const Attributes& attributes,
                                    GoalContext&) {
  return std::make_unique<BoxGoal>(read_box(element, attributes));
}

std::unique_ptr<GoalShape> make_turned_box(const Element&, const Attributes& attributes,
                                           GoalContext&) {
  return std::make_unique<TurnedBoxGoal>(read_turned_box(attributes, "x", "y"));
}

struct Shape {
  std::string_view word;
  AttributeTable attributes;
  GoalRegistry::Entry::Make make;
};

/// As elements choose them by `shape`, with the spellings of goals' types too.
const std::vector<Shape>& shapes() {
  static const std::vector<Shape> kShapes = {
      {"point", {number("x", "in m"), number("y", "in m")}, make_point},
      {"circle", circle_attributes("x", "y"), make_circle},
      {"aabb", box_attributes(), make_box},
      {"obb", turned_box_attributes("x", "y"), make_turned_box},
      {"AABB", box_attributes(), make_box},
      {"OBB", turned_box_attributes("x", "y"), make_turned_box},
  };
  return kShapes;
}

const Shape& shape_named(std::string_view word) {
  return *std::find_if(shapes().begin(), shapes().end(),
                       [&](const Shape& shape) { return shape.word == word; });
}

AttributeTable path_attributes() {
  AttributeTable table = {number("speed", "of the goal in m/s", 0, 1000),
                          boolean("closed", "1: on from the last point to the first; 0: back")};
  const AttributeTable shape = shape_choice_attributes();
  table.insert(table.end(), shape.begin(), shape.end());
  return table;
}

std::unique_ptr<GoalShape> make_path(const Element& element, const Attributes& attributes,
                                     GoalContext& context) {
  std::vector<Eigen::Vector2d> points;
  for (const Element& child : element.children()) {
    if (child.name() != "Point") child.fail_unknown("<Point>");
    child.require_no_children();
    const Attributes point(child, {number("x", "in m"), number("y", "in m")});
    points.emplace_back(point.number("x"), point.number("y"));
  }
  if (points.size() < 2) {
    element.fail(fmt::format("{} points", points.size()), "at least two <Point>");
  }
  context.path = std::make_unique<GoalPath>(std::move(points), attributes.number("speed"),
                                            attributes.boolean("closed"));
  return read_shape_choice(element, attributes);
}

}  // namespace

AttributeTable shape_choice_attributes() {
  std::vector<std::string_view> words;
  AttributeTable table;
  for (const Shape& shape : shapes()) {
    words.push_back(shape.word);
    for (const AttributeSpec& spec : shape.attributes) {
      const bool known = std::any_of(table.begin(), table.end(), [&](const AttributeSpec& other) {
        return other.name == spec.name;
      });
      if (!known) table.push_back(optional(spec));
    }
  }
  table.insert(table.begin(), word("shape", words, "which of the attributes here describe it"));
  return table;
}

std::unique_ptr<GoalShape> read_shape_choice(const Element& element, const Attributes& attributes) {
  const Shape& shape = shape_named(attributes.text("shape"));
  for (const AttributeSpec& spec : shape.attributes) {
    if (!attributes.has(spec.name)) {
      element.fail_attribute(spec.name, "nothing", std::string(spec.help));
    }
  }
  GoalContext no_path;
  return shape.make(element, attributes, no_path);
}

const GoalRegistry& goal_registry() {
  static const GoalRegistry kRegistry(
      {{
          {"point", "a point", shape_named("point").attributes, make_point},
          {"circle", "a disc", shape_named("circle").attributes, make_circle},
          {"AABB", "a box along the axes", shape_named("aabb").attributes, make_box},
          {"OBB", "a turned box", shape_named("obb").attributes, make_turned_box},
          {"path", "moves at constant speed along its <Point>s", path_attributes(), make_path},
      }},
      {integer("id", "unique within its set", 0, kMaxId),
       optional(integer("capacity", "how many agents may have it as their goal at a time", 0,
                        std::numeric_limits<std::uint32_t>::max()),
                "4294967295"),
       optional(number("weight", "for the weighted selector", 0, 1e6), "1")});
  return kRegistry;
}

}  // namespace throng::crowd
