#include "world/scenarios/blueprint/shorthand.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/geometry/angle.h"
#include "world/json_reader.h"
#include "world/props.h"
#include "world/scenarios/blueprint/frame.h"

namespace throng::scenarios {

using Eigen::Vector2d;
using nlohmann::json;
using world::JsonValue;

namespace {

constexpr double kMaxOutsideM = 100'000;

/// The list at a pointer of the document, if it is one.
json* list_at(json& document, const char* pointer) {
  const json::json_pointer at(pointer);
  if (!document.contains(at) || !document[at].is_array()) return nullptr;
  return &document[at];
}

/// A list whose items may have a box instead of an outline.
struct BoxList {
  const char* pointer;
  const char* outline;  ///< the field that a box stands for
};
constexpr std::array kBoxLists = {BoxList{"/buildings", "footprint"},
                                  BoxList{"/ground/areas", "corners"}, BoxList{"/scatter", "area"},
                                  BoxList{"/people/groups", "area"}};

void expand_boxes(const JsonValue& said, const BoxList& list, Expanded& expanded) {
  json* const items = list_at(expanded.blueprint, list.pointer);
  if (items == nullptr) return;
  const std::vector<JsonValue> values = said.items();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i]["box"].exists()) continue;
    const auto corners = values[i]["box"].tuple(4, "[x0, y0, x1, y1]");
    if (corners.empty()) continue;
    const auto number = [&](std::size_t k) {
      return corners[k].number(-kMaxOutsideM, kMaxOutsideM);
    };
    const Vector2d low(number(0), number(1));
    const Vector2d high(number(2), number(3));
    if ((low.array() >= high.array()).any()) {
      values[i]["box"].reject("x0 < x1 and y0 < y1");
      continue;
    }
    (*items)[i].erase("box");
    (*items)[i][list.outline] = outline_json(low, high);
    const std::string item = fmt::format("{}/{}", list.pointer, i);
    expanded.origins.emplace_back(item + "/" + list.outline, item + "/box");
  }
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
void add_row(const JsonValue& row, json& props) {
  row.fields({"kind", "from", "to", "apart_m"}, {"yaw_deg", "scale"});
  const Vector2d from = row["from"].vector2(kMaxOutsideM);
  const Vector2d to = row["to"].vector2(kMaxOutsideM);
  const double apart_m = row["apart_m"].number(0.2, 1000);
  const double length_m = (to - from).norm();
  int steps = static_cast<int>(std::lround(length_m / apart_m));
  const double along_deg = std::atan2(to.y() - from.y(), to.x() - from.x()) / kDegree;
  const std::string kind = row["kind"].text();
  const double scale = row["scale"].exists() ? row["scale"].number(0.2, 5) : 1;
  const double more_deg = row["yaw_deg"].exists() ? row["yaw_deg"].number(-180, 180) : 0;
  // One more than fits would push props that touch each other into each other.
  if (length_m < steps * own_length_m(kind, scale, more_deg * kDegree)) {
    steps = std::min(steps, static_cast<int>(length_m / apart_m + 1e-9));
  }
  for (int i = 0; i <= steps; ++i) {
    const double share = steps > 0 ? static_cast<double>(i) / steps : 0;
    json prop = {{"kind", kind},
                 {"position", point_json(from + share * (to - from))},
                 {"yaw_deg", std::remainder(along_deg + more_deg, 360.0)}};
    if (row["scale"].exists()) prop["scale"] = scale;
    props.push_back(std::move(prop));
  }
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
      const std::string missing = fmt::format("missing required field \"{}\"", list.outline);
      if (problem.found == missing && problem.where.starts_with(list.pointer)) {
        problem.found += " or \"box\"";
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
  const JsonValue root(said, source, problems);
  expand_boxes(root["buildings"], kBoxLists[0], expanded);
  expand_boxes(root["ground"]["areas"], kBoxLists[1], expanded);
  expand_boxes(root["scatter"], kBoxLists[2], expanded);
  expand_boxes(root["people"]["groups"], kBoxLists[3], expanded);
  if (root["rows"].exists()) {
    json& props = expanded.blueprint["props"];
    if (props.is_null()) props = json::array();
    if (!props.is_array()) root["props"].reject("an array");
    const std::vector<JsonValue> rows = root["rows"].items();
    for (std::size_t i = 0; props.is_array() && i < rows.size(); ++i) {
      const std::size_t first = props.size();
      add_row(rows[i], props);
      for (std::size_t k = first; k < props.size(); ++k) {
        expanded.origins.emplace_back(fmt::format("/props/{}", k), fmt::format("/rows/{}", i));
      }
    }
    expanded.blueprint.erase("rows");
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return expanded;
}

}  // namespace throng::scenarios
