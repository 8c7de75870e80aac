#include "world/fields/document_values.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/geometry/polygon.h"
#include "base/json/json_describe.h"

namespace throng::world {

using fields::FieldLocation;
using fields::Values;
using nlohmann::json;
using nlohmann::ordered_json;

ordered_json point_rules(int count, const std::string& expected) {
  ordered_json rules =
      fields::lists(count, count, fields::numbers(-kMaxCoordinateM, kMaxCoordinateM).rules).rules;
  rules["x-expected"] = expected;
  return rules;
}

Values points() { return {point_rules(2, "[x, y]")}; }

Values points_in_space() { return {point_rules(3, "[x, y, z]")}; }

Values polygons() { return fields::open_lists(3, points().rules); }

Values any_texts() { return {{{"type", "string"}}, "text"}; }

Values goals() {
  Values values = fields::lists(2, 2, fields::integers(0, kMaxId).rules);
  values.rules["x-expected"] = "[goal set, goal]";
  return values;
}

Values headings_deg() { return fields::numbers(-360, 360); }

GoalRef goal_named(const json& value) { return {value.at(0).get<int>(), value.at(1).get<int>()}; }

std::vector<Eigen::Vector2d> read_points(const json& value) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(value.size());
  for (const json& point : value) {
    points.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
  }
  return points;
}

std::vector<Eigen::Vector2d> read_polygon(const json& value, const FieldLocation& place,
                                          bool is_turned) {
  std::vector<Eigen::Vector2d> corners = read_points(value);
  if (!geometry::is_simple(corners)) {
    place.reject("edges that touch each other",
                 "a polygon whose corners all differ and whose edges do not cross");
  } else if (is_turned && geometry::signed_area(corners) < 0) {
    std::reverse(corners.begin(), corners.end());
  }
  return corners;
}

bool check_ends(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double min_length_m,
                const json& value, const FieldLocation& place) {
  if (!has_valid(value, "from", place) || !has_valid(value, "to", place)) return false;
  if ((to - from).norm() >= min_length_m) return true;
  place.below("to").reject(describe(value["to"]),
                           fmt::format("an end at least {} m from \"from\"", min_length_m));
  return false;
}

bool has_valid(const json& object, const char* field, const FieldLocation& place) {
  return object.is_object() && object.contains(field) && !place.has_problem(field);
}

}  // namespace throng::world
