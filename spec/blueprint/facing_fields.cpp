#include "spec/blueprint/facing_fields.h"

#include <nlohmann/json.hpp>

#include "base/json/json_describe.h"
#include "world/fields/document_values.h"

namespace throng::scenarios {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr const char* kRandom = "random";
constexpr const char* kExpectedFacing =
    "\"random\", or an object with \"towards\" or \"direction_deg\"";

void add_spread(FieldTable<Facing>& table) {
  table.add("spread_deg", "", "°", fields::numbers(0, 180), at(&Facing::spread_deg),
            "Standard deviation about that direction.");
}

const FieldTable<Facing>& towards_fields() {
  static const FieldTable<Facing> fields = [] {
    FieldTable<Facing> table;
    table
        .add("towards", "", "m", world::points(), at(&Facing::point),
             "Point that they look at, for example a stage.")
        .required();
    add_spread(table);
    return table;
  }();
  return fields;
}

const FieldTable<Facing>& direction_fields() {
  static const FieldTable<Facing> fields = [] {
    FieldTable<Facing> table;
    table
        .add("direction_deg", "", "°", world::headings_deg(), at(&Facing::angle_deg),
             "Direction, counter-clockwise from +x.")
        .required();
    add_spread(table);
    return table;
  }();
  return fields;
}

}  // namespace

fields::Values facing_values() {
  ordered_json forms =
      ordered_json::array({fields::one_of_words(std::array{kRandom}).rules,
                           fields::form("They look at a point.", towards_fields().schema()),
                           fields::form("They look in a direction.", direction_fields().schema())});
  return {{{"type", {"string", "object"}}, {"anyOf", std::move(forms)}}, kExpectedFacing};
}

Facing read_facing(const json& value, const FieldLocation& place) {
  Facing facing;
  if (value == kRandom) return facing;
  const bool has_point = value.is_object() && value.contains("towards");
  const bool has_angle = value.is_object() && value.contains("direction_deg");
  if (has_point && has_angle) {
    place.reject("both \"towards\" and \"direction_deg\"", "one of them");
  } else if (has_point) {
    facing.kind = Facing::Kind::towards;
    towards_fields().read_checked(value, facing, place);
  } else if (has_angle) {
    facing.kind = Facing::Kind::direction;
    direction_fields().read_checked(value, facing, place);
  } else {
    place.reject(describe(value), kExpectedFacing);
  }
  return facing;
}

}  // namespace throng::scenarios
