#include "crowd/goals.h"

#include <fmt/core.h>

#include "crowd/shape_attributes.h"

namespace throng::crowd {

namespace {

class PointGoal : public GoalShape {
 public:
  explicit PointGoal(const Eigen::Vector2f& point) : point_(point) {}
  Eigen::Vector2f centre() const override { return point_; }
  void move_to(const Eigen::Vector2f& centre) override { point_ = centre; }
  Eigen::Vector2f nearest_point(const Eigen::Vector2f&, float) const override { return point_; }

 private:
  Eigen::Vector2f point_;
};

class CircleGoal : public GoalShape {
 public:
  explicit CircleGoal(const Circle& circle) : circle_(circle) {}
  Eigen::Vector2f centre() const override { return circle_.centre; }
  void move_to(const Eigen::Vector2f& centre) override { circle_.centre = centre; }
  Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const override {
    return circle_.nearest_point(p, margin);
  }

 private:
  Circle circle_;
};

class BoxGoal : public GoalShape {
 public:
  explicit BoxGoal(const Box& box) : box_(box) {}
  Eigen::Vector2f centre() const override { return box_.centre(); }
  void move_to(const Eigen::Vector2f& centre) override {
    const Eigen::Vector2f half = 0.5F * (box_.max - box_.min);
    box_ = {centre - half, centre + half};
  }
  Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const override {
    return box_.nearest_point(p, margin);
  }

 private:
  Box box_;
};

class TurnedBoxGoal : public GoalShape {
 public:
  explicit TurnedBoxGoal(const TurnedBox& box) : box_(box) {}
  Eigen::Vector2f centre() const override { return box_.to_world(box_.box().centre()); }
  void move_to(const Eigen::Vector2f& centre) override { box_.pivot += centre - this->centre(); }
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

}  // namespace

const GoalRegistry& goal_registry() {
  static const GoalRegistry kRegistry(
      {{
          {"point", "a point", {number("x", "in m"), number("y", "in m")}, make_point},
          {"circle", "a disc", circle_attributes("x", "y"), make_circle},
          {"AABB", "a box along the axes", box_attributes(), make_box},
          {"OBB", "a turned box", turned_box_attributes("x", "y"), make_turned_box},
      }},
      {integer("id", "unique within its set", 0, kHighestId),
       optional(integer("capacity", "how many agents may have it as their goal at a time", 0,
                        std::numeric_limits<std::uint32_t>::max()),
                "4294967295"),
       optional(number("weight", "for the weighted selector", 0, 1e6), "1")});
  return kRegistry;
}

void Goals::load_set(const Element& element) {
  const Attributes set_attributes(element,
                                  {integer("id", "unique among the goal sets", 0, kHighestId)});
  GoalSet made;
  made.id = static_cast<int>(set_attributes.integer("id"));
  if (find_set(made.id) >= 0) {
    element.fail_attribute("id", fmt::format("{} again", made.id), "an id not used before");
  }
  sets_.push_back(made);
  for (const Element& child : element.children()) {
    if (child.name() != "Goal") child.fail_unknown("<Goal>");
    child.require_no_children();
    const Attributes attributes(child, goal_registry().find(child).attributes);
    Goal goal;
    goal.id = {made.id, static_cast<std::int32_t>(attributes.integer("id"))};
    if (find_goal(goal.id.set, goal.id.goal) >= 0) {
      child.fail_attribute("id", fmt::format("{} again", goal.id.goal),
                           "an id not used before in this set");
    }
    goal.capacity = static_cast<std::uint32_t>(attributes.integer("capacity"));
    goal.weight = attributes.real("weight");
    GoalContext context;
    goal.shape = goal_registry().make(child, context);
    sets_.back().goals.push_back(static_cast<int>(goals_.size()));
    goals_.push_back(std::move(goal));
  }
  if (sets_.back().goals.empty()) element.fail("an empty set", "at least one <Goal>");
}

int Goals::find_set(int set_id) const {
  for (std::size_t i = 0; i < sets_.size(); ++i) {
    if (sets_[i].id == set_id) return static_cast<int>(i);
  }
  return -1;
}

int Goals::find_goal(int set_id, int goal_id) const {
  const int index = find_set(set_id);
  if (index < 0) return -1;
  for (const int goal : set(index).goals) {
    if ((*this)[goal].id.goal == goal_id) return goal;
  }
  return -1;
}

int Goals::require_set(const Element& element, const Attributes& attributes,
                       std::string_view attribute) const {
  const auto id = static_cast<int>(attributes.integer(attribute));
  const int index = find_set(id);
  if (index >= 0) return index;
  std::string known;
  for (const GoalSet& each : sets_) known += fmt::format(" {}", each.id);
  element.fail_attribute(
      attribute, fmt::format("{}, which is no goal set", id),
      known.empty() ? "a goal set (there is none)" : fmt::format("the id of a goal set:{}", known));
}

}  // namespace throng::crowd
