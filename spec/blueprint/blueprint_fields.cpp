#include "spec/blueprint/blueprint_fields.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "spec/blueprint/people_fields.h"
#include "world/fields/document_values.h"
#include "world/fields/prop_fields.h"
#include "world/fields/scenario_fields.h"

namespace throng::scenarios {

using fields::at;
using fields::FieldRules;
using fields::FieldTable;
using nlohmann::ordered_json;

namespace {

/// Fields of a scenario that a blueprint does not have, since they follow from its people.
constexpr std::array<std::string_view, 6> kOfCrowd = {
    "crowd", "crowd/scene", "crowd/behavior", "crowd/model", "disaster_agents", "guides_alert"};

/// The rules of a scenario's exits without goals, which follow from the people.
void take_goals(FieldRules& exits) {
  ordered_json& properties = exits.values.rules["items"]["properties"];
  properties.erase("goals");
  properties["open"]["description"] =
      "False closes the door for the whole run: people choose another, drones lead nobody there.";
  properties["closes_at_s"]["description"] = "Time from which nobody passes an open door any more.";
}

/// Permits a box instead of an outline in the schema of a list.
void add_box(const BoxList& list, ordered_json& schema) {
  constexpr std::string_view kProperties = "/properties";
  std::string place = list.pointer;
  for (std::size_t at = 0; (at = place.find('/', at)) != std::string::npos;
       at += kProperties.size() + 1) {
    place.insert(at, kProperties);
  }
  ordered_json& items = schema[ordered_json::json_pointer(place)]["items"];
  ordered_json& required = items["required"];
  required.erase(std::find(required.begin(), required.end(), list.outline));
  items["properties"].update(box_fields().schema()["properties"]);
}

FieldRules rules_named(std::string path, fields::Values values, std::string help) {
  FieldRules rules;
  rules.path = std::move(path);
  rules.values = std::move(values);
  rules.help = std::move(help);
  return rules;
}

}  // namespace

const FieldTable<Box>& box_fields() {
  static const FieldTable<Box> fields = [] {
    FieldTable<Box> table;
    table
        .add("box", "", "m", {world::point_rules(4, "[x0, y0, x1, y1]")}, at(&Box::corners),
             "A rectangle [x0, y0, x1, y1] with x0 < x1 and y0 < y1, instead of corners.")
        .without_default();
    return table;
  }();
  return fields;
}

const FieldTable<PropRow>& row_fields() {
  static const FieldTable<PropRow> fields = [] {
    FieldTable<PropRow> table;
    table.add("kind", "", "", world::prop_kinds(), at(&PropRow::kind), "Kind of prop.").required();
    table.add("from", "", "m", world::points(), at(&PropRow::from), "Position of the first prop.")
        .required();
    table.add("to", "", "m", world::points(), at(&PropRow::to), "Position of the last prop.")
        .required();
    table
        .add("apart_m", "", "m", fields::numbers(0.2, 1000), at(&PropRow::apart_m),
             "Distance between neighbors, made a little larger or smaller so that both ends have a "
             "prop, but not smaller than the prop.")
        .required();
    table.add("yaw_deg", "", "°", fields::numbers(-180, 180), at(&PropRow::yaw_deg),
              "Angle that is added to the row's direction.");
    table.add("scale", "", "", world::prop_scales(), at(&PropRow::scale),
              "Size relative to the usual one.");
    return table;
  }();
  return fields;
}

fields::Values row_lists() {
  return fields::open_lists(0, fields::object_with(row_fields().schema()).rules);
}

std::vector<FieldRules> blueprint_rules() {
  std::vector<FieldRules> rules;
  for (const FieldRules* field : world::scenario_fields().rules()) {
    if (std::find(kOfCrowd.begin(), kOfCrowd.end(), field->path) != kOfCrowd.end()) continue;
    rules.push_back(*field);
    if (field->path == "exits") take_goals(rules.back());
    if (field->path != "disasters") continue;
    rules.back() =
        rules_named("disasters", danger_lists(), "Hazards and their effects on the crowd.");
  }
  rules.push_back(rules_named("people", fields::object_with(people_fields().schema()),
                              "People and their behavior."));
  rules.back().is_required = true;
  return rules;
}

ordered_json blueprint_schema() {
  std::vector<FieldRules> rules = blueprint_rules();
  rules.push_back(rules_named("rows", row_lists(), "Props in rows."));
  std::vector<const FieldRules*> all;
  all.reserve(rules.size());
  for (const FieldRules& field : rules) all.push_back(&field);
  ordered_json schema = world::extendable_schema(
      "throng blueprint", "A scenario with its people and hazards in one file (docs/blueprint.md).",
      fields::schema_for(all));
  for (const BoxList& list : kBoxLists) add_box(list, schema);
  return schema;
}

}  // namespace throng::scenarios
