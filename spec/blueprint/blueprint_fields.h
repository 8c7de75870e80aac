// Fields of a blueprint: those of a scenario, except that a blueprint has people instead of the
// files of a crowd, boxes beside outlines, and rows of props.
#pragma once

#include <Eigen/Core>
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/json/field_table.h"
#include "world/props.h"

namespace throng::scenarios {

/// A list of a blueprint whose items may have a "box" instead of an outline.
struct BoxList {
  const char* pointer;
  const char* outline;  ///< field of an item that a box replaces
};
inline constexpr std::array<BoxList, 4> kBoxLists = {{{"/buildings", "footprint"},
                                                      {"/ground/areas", "corners"},
                                                      {"/scatter", "area"},
                                                      {"/people/groups", "area"}}};

/// A rectangle [x0, y0, x1, y1], in m.
struct Box {
  Eigen::Vector4d corners = Eigen::Vector4d::Zero();
};

/// The field "box".
const fields::FieldTable<Box>& box_fields();

/// Props of one kind in a row.
struct PropRow {
  std::string kind;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  double apart_m = 1;
  double yaw_deg = 0;  ///< added to the row's direction
  double scale = 1;
};

/// The fields of an item of "rows".
const fields::FieldTable<PropRow>& row_fields();

/// The rules of the list "rows".
fields::Values row_lists();

/// The rules of the fields of a blueprint without shorthand: boxes and rows.
std::vector<fields::FieldRules> blueprint_rules();

/// The JSON Schema of blueprints.
nlohmann::ordered_json blueprint_schema();

}  // namespace throng::scenarios
