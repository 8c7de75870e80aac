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
/// Names of letters, digits, '_' and '-' (see set_id()).
fields::Values ids();
/// [goal set, goal].
fields::Values goals();
/// Headings in degrees, counter-clockwise from +x.
fields::Values headings_deg();
/// Lists of at least `min_items` elements.
fields::Values open_lists(int min_items, nlohmann::ordered_json items);
/// Lists of objects with the schema() of a table.
fields::Values object_lists(const nlohmann::ordered_json& fields);

/// Stores an id; adds a problem for other characters than an id has.
void set_id(std::string& id, const nlohmann::json& value, const fields::FieldLocation& place);
/// Reads a checked value of goals().
GoalRef goal_named(const nlohmann::json& value);
/// Reads checked points.
std::vector<Eigen::Vector2d> read_points(const nlohmann::json& value);
/// Adds a problem if a polygon's edges touch each other, and returns whether they do not.
bool check_simple(const std::vector<Eigen::Vector2d>& corners, const fields::FieldLocation& place);
/// Adds a problem at "to" if the segment from "from" to "to" of an object is shorter than this;
/// returns whether both ends are there and it is not.
bool check_ends(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double min_length_m,
                const nlohmann::json& value, const fields::FieldLocation& place);

/// Whether an object has a field whose value has no problem.
bool has_valid(const nlohmann::json& object, const char* field, const fields::FieldLocation& place);

/// Reads the elements of a list with read(element, location, index).
template <typename Read>
auto read_list(const nlohmann::json& list, const fields::FieldLocation& place, Read read) {
  std::vector<decltype(read(list, place, std::size_t{0}))> parts;
  parts.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) parts.push_back(read(list[i], place.below(i), i));
  return parts;
}

/// Adds the id of a part.
template <typename Part>
void add_id(fields::FieldTable<Part>& table) {
  table
      .add(
          "id", "", "", ids(), [](const Part& part) { return fields::value_json(part.id); },
          [](Part& part, const nlohmann::json& value, const fields::FieldLocation& place) {
            set_id(part.id, value, place);
          },
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
