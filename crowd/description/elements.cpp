#include "crowd/description/elements.h"

#include <fmt/core.h>

#include <iterator>
#include <utility>

namespace throng::crowd::describe {

using Eigen::Vector2d;

namespace {

std::string coordinate(double value, int decimals) {
  return decimals == kAllDigits ? number_text(value) : decimals_text(value, decimals);
}

std::vector<Attribute> joined(std::vector<Attribute> first, std::vector<Attribute> more) {
  first.insert(first.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
  return first;
}

Node point(std::string name, const Vector2d& at, int decimals) {
  return Node(std::move(name),
              {{"p_x", coordinate(at.x(), decimals)}, {"p_y", coordinate(at.y(), decimals)}});
}

}  // namespace

std::string significant_text(double value, int digits) {
  return fmt::format("{:.{}g}", value, digits);
}

Node typed(std::string name, std::string_view type, std::vector<Attribute> attributes,
           std::vector<Node> children) {
  return Node(std::move(name), joined({{"type", type}}, std::move(attributes)),
              std::move(children));
}

Sampled Sampled::constant(double value) { return Sampled({{"dist", "c"}, {"value", value}}); }

Sampled Sampled::uniform(double min, double max) {
  return Sampled({{"dist", "u"}, {"min", min}, {"max", max}});
}

Sampled Sampled::normal(double mean, double stddev) {
  return Sampled({{"dist", "n"}, {"mean", mean}, {"stddev", stddev}});
}

Sampled Sampled::lognormal(double log_mean, double log_stddev) {
  return Sampled({{"dist", "lognormal"}, {"log_mean", log_mean}, {"log_stddev", log_stddev}});
}

Sampled Sampled::limited(double at_least, double at_most) const {
  return Sampled(joined(attributes_, {{"at_least", at_least}, {"at_most", at_most}}));
}

std::vector<Attribute> Sampled::attributes(std::string_view prefix) const {
  std::vector<Attribute> prefixed = attributes_;
  for (Attribute& attribute : prefixed) attribute.name.insert(0, prefix);
  return prefixed;
}

Node property(std::string_view name, const Sampled& value) {
  return Node("Property", joined({{"name", name}}, value.attributes()));
}

Node model(std::string tag, std::vector<Attribute> attributes) {
  return Node(std::move(tag), std::move(attributes));
}

Node agents_at(const Points& points, int decimals) {
  Node generator = typed("Generator", "explicit");
  for (const Vector2d& at : points) generator.add(point("Agent", at, decimals));
  return generator;
}

std::vector<Node> vertices(const Points& points, int decimals) {
  std::vector<Node> nodes;
  nodes.reserve(points.size());
  for (const Vector2d& at : points) nodes.push_back(point("Vertex", at, decimals));
  return nodes;
}

Node obstacle(const Points& outline, int decimals) {
  return Node("Obstacle", {{"closed", true}}, vertices(outline, decimals));
}

Node circle_goal(int id, const Vector2d& center, double radius_m, int decimals) {
  return Node("Goal", {{"id", id},
                       {"type", "circle"},
                       {"x", coordinate(center.x(), decimals)},
                       {"y", coordinate(center.y(), decimals)},
                       {"radius", radius_m}});
}

Node box_goal(int id, const Vector2d& min, const Vector2d& max) {
  return Node("Goal", {{"id", id},
                       {"type", "AABB"},
                       {"min_x", min.x()},
                       {"min_y", min.y()},
                       {"max_x", max.x()},
                       {"max_y", max.y()}});
}

Node select_goal(std::string_view type, int goal_set, std::vector<Attribute> more) {
  return typed("GoalSelector", type, joined({{"goal_set", goal_set}}, std::move(more)));
}

Node select_goal(int goal_set, int goal) {
  return select_goal("explicit", goal_set, {{"goal", goal}});
}

Node select_own_place() { return typed("GoalSelector", "identity"); }

Node velocity(std::string_view type, std::vector<Attribute> attributes) {
  return typed("VelComponent", type, std::move(attributes));
}

Node action(std::string_view type, std::vector<Attribute> attributes) {
  return typed("Action", type, std::move(attributes));
}

Node condition(std::string_view type, std::vector<Attribute> attributes, std::vector<Node> parts) {
  return typed("Condition", type, std::move(attributes), std::move(parts));
}

Node goal_reached(double distance_m) {
  return condition("goal_reached", {{"distance", distance_m}});
}

Node timer(const Sampled& time_s, bool per_agent) {
  return condition("timer", joined(time_s.attributes(), {{"per_agent", per_agent}}));
}

}  // namespace throng::crowd::describe
