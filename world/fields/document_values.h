// Values that many fields of a scenario have: points, polygons, ids, lists of objects.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

inline constexpr double kMaxCoordinateM = 100'000;
inline constexpr int kMaxId = 1'000'000'000;

/// A list of `count` coordinates in m, which messages call `expected`.
nlohmann::ordered_json point_rules(int count, const std::string& expected);
/// [x, y] in m.
fields::Values points();
/// [x, y, z] in m.
fields::Values points_in_space();
/// The corners of a polygon in m, in order.
fields::Values polygons();
/// Texts of any length.
fields::Values any_texts();
/// [goal set, goal].
fields::Values goals();
/// Headings in degrees, counter-clockwise from +x.
fields::Values headings_deg();

/// Reads a checked value of goals().
GoalRef goal_named(const nlohmann::json& value);
/// Reads checked points.
std::vector<Eigen::Vector2d> read_points(const nlohmann::json& value);
/// Reads the corners of a polygon; adds a problem if its edges touch each other. With
/// `is_turned`, the corners of one that is sound are put in counter-clockwise order.
std::vector<Eigen::Vector2d> read_polygon(const nlohmann::json& value,
                                          const fields::FieldLocation& place,
                                          bool is_turned = false);
/// Adds a problem at "to" if the segment from "from" to "to" of an object is shorter than this;
/// returns whether both ends are there and it is not.
bool check_ends(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double min_length_m,
                const nlohmann::json& value, const fields::FieldLocation& place);

/// Whether an object has a field whose value has no problem.
bool has_valid(const nlohmann::json& object, const char* field, const fields::FieldLocation& place);

/// Adds the id of a part.
template <typename Part>
void add_id(fields::FieldTable<Part>& table) {
  table
      .add("id", "", "", fields::names(), fields::at(&Part::id),
           "An identifier: letters, digits, '_' and '-'.")
      .required();
}

/// Adds a problem for each part whose id another one before it has.
template <typename Part>
void check_ids(const std::vector<Part>& parts, const fields::FieldLocation& place) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& id = parts[i].id;
    if (id.empty() || seen.insert(id).second) continue;
    place.below(i).below("id").reject('"' + id + '"', "an id that nothing else has");
  }
}

}  // namespace throng::world
