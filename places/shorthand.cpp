#include "places/shorthand.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "geometry/angle.h"
#include "places/frame.h"
#include "world/json_reader.h"
#include "world/props.h"

namespace throng::places {

using Eigen::Vector2d;
using nlohmann::json;
using world::JsonValue;

namespace {

constexpr double kMaxOutsideM = 100'000;

/// The list at a place of the document, if it is one.
json* list_at(json& document, const char* pointer) {
  const json::json_pointer place(pointer);
  if (!document.contains(place) || !document[place].is_array()) return nullptr;
  return &document[place];
}

void expand_boxes(const JsonValue& said, json& items, const char* outline) {
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
    items[i].erase("box");
    items[i][outline] = outline_json(low, high);
  }
}

/// How much of a row one of its props takes, m; 0 of an unknown kind, which is refused elsewhere.
double own_length_m(const JsonValue& row, double turn_rad) {
  const double scale = row["scale"].exists() ? row["scale"].number(0.2, 5) : 1;
  const std::string kind = row["kind"].text();
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
  const double along_deg =
      std::atan2(to.y() - from.y(), to.x() - from.x()) * 180 / std::numbers::pi;
  const double more_deg = row["yaw_deg"].exists() ? row["yaw_deg"].number(-180, 180) : 0;
  // One more than fits would push props that touch each other into each other.
  if (length_m < steps * own_length_m(row, more_deg * kDegree)) {
    steps = std::min(steps, static_cast<int>(length_m / apart_m + 1e-9));
  }
  for (int i = 0; i <= steps; ++i) {
    const double share = steps > 0 ? static_cast<double>(i) / steps : 0;
    json prop = {{"kind", row["kind"].text()},
                 {"position", point_json(from + share * (to - from))},
                 {"yaw_deg", std::remainder(along_deg + more_deg, 360.0)}};
    if (row["scale"].exists()) prop["scale"] = row["scale"].number(0.2, 5);
    props.push_back(std::move(prop));
  }
}

}  // namespace

void expand_shorthand(json& blueprint, const std::string& source, std::vector<Problem>& problems) {
  const json as_said = blueprint;
  const JsonValue root(as_said, source, problems);
  if (json* list = list_at(blueprint, "/buildings")) {
    expand_boxes(root["buildings"], *list, "footprint");
  }
  if (json* list = list_at(blueprint, "/ground/areas")) {
    expand_boxes(root["ground"]["areas"], *list, "corners");
  }
  if (json* list = list_at(blueprint, "/scatter")) expand_boxes(root["scatter"], *list, "area");
  if (json* list = list_at(blueprint, "/people/groups")) {
    expand_boxes(root["people"]["groups"], *list, "area");
  }
  if (!root["rows"].exists()) return;
  if (!blueprint.contains("props")) blueprint["props"] = json::array();
  if (!blueprint["props"].is_array()) return root["props"].reject("an array");
  for (const JsonValue& row : root["rows"].items()) add_row(row, blueprint["props"]);
  blueprint.erase("rows");
}

}  // namespace throng::places
