#include "places/scenarios/blueprint/shorthand.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/geometry/angle.h"
#include "base/json/json_describe.h"
#include "places/scenarios/blueprint/frame.h"
#include "spec/blueprint/blueprint_fields.h"
#include "world/props.h"

namespace throng::scenarios {

using Eigen::Vector2d;
using fields::FieldLocation;
using nlohmann::json;

namespace {

/// The list at a pointer of the document, if it is one.
json* list_at(json& document, const char* pointer) {
  const json::json_pointer at(pointer);
  if (!document.contains(at) || !document[at].is_array()) return nullptr;
  return &document[at];
}

/// Replaces the box of an item by its outline. `place` is the position of the item.
void expand_box(const BoxList& list, json& item, const FieldLocation& place, Expanded& expanded) {
  if (!item.is_object() || !item.contains("box")) return;
  const auto& field = box_fields().fields().front();
  const FieldLocation box_place = place.below("box");
  if (!fields::check_value(item["box"], field.values, box_place)) return;
  Box box;
  field.set(box, item["box"], box_place);
  const Vector2d low = box.corners.head<2>();
  const Vector2d high = box.corners.tail<2>();
  if ((low.array() >= high.array()).any()) {
    box_place.reject(throng::describe(item["box"]), "x0 < x1 and y0 < y1");
    return;
  }
  item.erase("box");
  item[list.outline] = outline_json(low, high);
  expanded.origins.emplace_back(place.below(list.outline).pointer, box_place.pointer);
}

/// How much of a row one prop of the kind takes, m; 0 of an unknown kind, which is refused
/// elsewhere.
double own_length_m(const std::string& kind, double scale, double turn_rad) {
  for (const world::PropType& type : world::prop_types()) {
    if (kind != type.name) continue;
    return 2 * scale *
           (std::abs(std::cos(turn_rad)) * type.half_size.x() +
            std::abs(std::sin(turn_rad)) * type.half_size.y());
  }
  return 0;
}

/// A row of one kind of prop from a point to another, both included.
void add_row(const json& value, const FieldLocation& place, json& props) {
  PropRow row;
  const std::size_t problems = place.problems.size();
  row_fields().read_checked(value, row, place);
  if (place.problems.size() > problems) return;
  const auto& [kind, from, to, apart_m, more_deg, scale] = row;
  const double length_m = (to - from).norm();
  int steps = static_cast<int>(std::lround(length_m / apart_m));
  const double along_deg = std::atan2(to.y() - from.y(), to.x() - from.x()) / kDegree;
  // One more than fits would push props that touch each other into each other.
  if (length_m < steps * own_length_m(kind, scale, more_deg * kDegree)) {
    steps = std::min(steps, static_cast<int>(length_m / apart_m + 1e-9));
  }
  for (int i = 0; i <= steps; ++i) {
    const double share = steps > 0 ? static_cast<double>(i) / steps : 0;
    json prop = {{"kind", kind},
                 {"position", point_json(from + share * (to - from))},
                 {"yaw_deg", std::remainder(along_deg + more_deg, 360.0)}};
    if (value.contains("scale")) prop["scale"] = scale;
    props.push_back(std::move(prop));
  }
}

/// Adds the props of "rows" to "props". `root` is the position of the blueprint.
void expand_rows(const json& rows, const FieldLocation& root, Expanded& expanded) {
  json& props = expanded.blueprint["props"];
  if (props.is_null()) props = json::array();
  if (!props.is_array()) root.below("props").reject(throng::describe(props), "an array");
  if (!rows.is_array()) root.below("rows").reject(throng::describe(rows), row_lists().expected);
  for (std::size_t i = 0; props.is_array() && rows.is_array() && i < rows.size(); ++i) {
    const std::size_t first = props.size();
    const FieldLocation place = root.below("rows").below(i);
    add_row(rows[i], place, props);
    for (std::size_t k = first; k < props.size(); ++k) {
      expanded.origins.emplace_back(fmt::format("/props/{}", k), place.pointer);
    }
  }
  expanded.blueprint.erase("rows");
}

/// The deepest part of a pointer that the document has.
std::string existing_part(json::json_pointer pointer, const json& document) {
  while (!pointer.empty() && !document.contains(pointer)) pointer.pop_back();
  return pointer.to_string();
}

}  // namespace

std::vector<Problem> Expanded::as_said(std::vector<Problem> problems, const json& said) const {
  std::vector<Problem> renamed;
  for (Problem& problem : problems) {
    for (const auto& [part, origin] : origins) {
      if (problem.where != part && !problem.where.starts_with(part + "/")) continue;
      const std::string rest = problem.where.substr(part.size());
      problem.where = existing_part(json::json_pointer(origin + rest), said);
      break;
    }
    for (const BoxList& list : kBoxLists) {
      if (problem.found == "nothing" && problem.where.starts_with(list.pointer) &&
          problem.where.ends_with(std::string("/") + list.outline)) {
        problem.expected += ", or \"box\": [x0, y0, x1, y1]";
      }
    }
    const bool is_said = std::any_of(renamed.begin(), renamed.end(), [&](const Problem& other) {
      return other.text() == problem.text();
    });
    if (!is_said) renamed.push_back(std::move(problem));
  }
  return renamed;
}

Expanded expand_shorthand(const json& said, const std::string& source) {
  std::vector<Problem> problems;
  Expanded expanded{said, {}};
  const FieldLocation root{"", source, problems};
  for (const BoxList& list : kBoxLists) {
    json* const items = list_at(expanded.blueprint, list.pointer);
    for (std::size_t i = 0; items != nullptr && i < items->size(); ++i) {
      const FieldLocation place{fmt::format("{}/{}", list.pointer, i), source, problems};
      expand_box(list, (*items)[i], place, expanded);
    }
  }
  if (said.is_object() && said.contains("rows")) expand_rows(said["rows"], root, expanded);
  if (!problems.empty()) throw InputError(std::move(problems));
  return expanded;
}

}  // namespace throng::scenarios
