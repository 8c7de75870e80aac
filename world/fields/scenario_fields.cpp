#include "world/fields/scenario_fields.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/geometry/polygon.h"
#include "base/json/json_describe.h"
#include "base/text/control_characters.h"
#include "world/fields/disaster_fields.h"
#include "world/fields/document_values.h"
#include "world/fields/exit_fields.h"
#include "world/fields/ground_fields.h"
#include "world/fields/prop_fields.h"
#include "world/fields/scenario_parts.h"
#include "world/fields/stand_fields.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

const FieldTable<Rectangle>& rectangle_fields() {
  static const FieldTable<Rectangle> fields = [] {
    FieldTable<Rectangle> table;
    table.add("min", "", "m", points(), at(&Rectangle::min), "Corner with the smallest x and y.")
        .required();
    table
        .add(
            "max", "", "m", points(),
            [](const Rectangle& area) { return fields::value_json(area.max); },
            [](Rectangle& area, const json& value, const FieldLocation& place) {
              fields::set_value(value, area.max);
              FieldLocation object = place;
              object.pointer.resize(object.pointer.rfind('/'));
              if (object.has_problem("min") || (area.min.array() < area.max.array()).all()) return;
              place.reject(describe(value), "a corner right of and above \"min\"");
            },
            "Corner with the largest x and y.")
        .required();
    return table;
  }();
  return fields;
}

const FieldTable<geometry::Region>& polygon_fields() {
  static const FieldTable<geometry::Region> fields = [] {
    FieldTable<geometry::Region> table;
    table
        .add_read(
            "corners", polygons(),
            [](geometry::Region& region, const json& value, const FieldLocation& place) {
              region.outline = read_polygon(value, place, true);
              region.bounds = geometry::bounding_box(region.outline);
            },
            "The corners of a polygon in order, instead of min and max; the edges must not cross.")
        .measured_in("m")
        .required();
    return table;
  }();
  return fields;
}

fields::Values regions() {
  const ordered_json polygon = polygon_fields().schema();
  const ordered_json rectangle = rectangle_fields().schema();
  ordered_json rules = {{"type", "object"},
                        {"additionalProperties", false},
                        {"anyOf", ordered_json::array({{{"required", rectangle["required"]}},
                                                       {{"required", polygon["required"]}}})},
                        {"properties", polygon["properties"]}};
  rules["properties"].update(rectangle["properties"]);
  return {std::move(rules)};
}

void set_inside(Scenario& scenario, const json& value, const FieldLocation& place) {
  if (value.contains("corners")) {
    polygon_fields().read_checked(value, scenario.inside, place);
  } else {
    rectangle_fields().read_checked(value, scenario.inside.bounds, place);
  }
}

void add_files(FieldTable<Scenario>& table) {
  table
      .group("crowd", "",
             "Files of the crowd, beside this one; a scenario for recorded people has none, and "
             "cannot be simulated.")
      .without_default();
  table
      .add_read(
          "crowd/scene", any_texts(),
          [](Scenario& scenario, const json& value, const FieldLocation& place) {
            scenario.scene_file = read_companion(value, place);
          },
          "Menge's scene file (XML).")
      .required();
  table
      .add_read(
          "crowd/behavior", any_texts(),
          [](Scenario& scenario, const json& value, const FieldLocation& place) {
            scenario.behavior_file = read_companion(value, place);
          },
          "Menge's behavior file (XML).")
      .required();
  table.add("crowd/model", "", "", any_texts(), at(&Scenario::crowd_model),
            "Pedestrian model that these files were made for, used by jobs that name none; "
            "default: ttc.");
}

void add_ground(FieldTable<Scenario>& table) {
  table.group("ground", "", "The ground that is rendered.").required();
  table.add_all("ground", rectangle_fields(), at(&Scenario::ground));
  table
      .add("ground/material", "", "", ground_materials(), at(&Scenario::ground_material),
           "Material of the ground.")
      .required();
  table.add_list("ground/areas", area_fields(), at(&Scenario::areas),
                 "Areas of other materials, later ones on top.");
  table
      .add_list("ground/markings", marking_fields(), at(&Scenario::markings),
                "Painted strips on the ground.")
      .checked(check_markings);
}

void set_disaster_agents(Scenario& scenario, const json& list, const FieldLocation& place) {
  std::vector<int>& agents = scenario.disaster_agents;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const int agent = list[i].get<int>();
    if (std::find(agents.begin(), agents.end(), agent) != agents.end()) {
      place.below(i).reject(list[i].dump(), "every agent once");
    }
    agents.push_back(agent);
  }
}

void add_hazards(FieldTable<Scenario>& table) {
  table.add_read("disaster_agents", fields::open_lists(0, fields::integers(0, kMaxId).rules),
                 set_disaster_agents,
                 "Agents that stand for a hazard. They are neither rendered nor counted; without "
                 "disasters, smoke rises from them all the time if the job wants it "
                 "(environment.smoke).");
  table
      .add_list("disasters", listed_disaster_fields(), at(&Scenario::disasters),
                "Visible hazards, if the job wants them (environment.smoke).")
      .checked(check_disaster_agents);
  table.add("guides_alert", "", "", fields::booleans(), at(&Scenario::guides_alert),
            "Whether the behavior file lets people who have noticed nothing follow a drone; "
            "policies reckon with it.");
}

/// Parts on the ground. A row is read after the ones before it, which its rules concern.
void add_parts(FieldTable<Scenario>& table) {
  table
      .add_read("inside", regions(), set_inside,
                "People who leave it have escaped: a rectangle (min, max) or a polygon (corners).")
      .required();
  table
      .add_list("exits", exit_fields(), at(&Scenario::exits),
                "Doors that lead out: segments on the ground that people cross to get out.", 1)
      .expecting("a list of at least one exit")
      .checked(check_exits)
      .required();
  table
      .add_list("doors", inner_door_fields(), at(&Scenario::doors),
                "Doors inside, turnstiles and ticket gates whose capacity people are held to: "
                "segments on the ground. Walls beside them are buildings.")
      .checked(check_inner_doors);
  table.add_list("buildings", building_fields(), at(&Scenario::buildings), "Buildings and walls.")
      .checked([](const Scenario& scenario, const json& /*list*/, const FieldLocation& place) {
        check_ids(scenario.buildings, place);
      });
  table.add_list("stands", stand_fields(), at(&Scenario::stands), "Tiers of seats.")
      .checked(check_stands);
  table.add_list("drones", drone_fields(), at(&Scenario::drones), "Drones that jobs fly.")
      .checked(check_drones);
  table.add_list("meshes", mesh_fields(), at(&Scenario::meshes), "Meshes that are rendered.");
  table.add_list("props", prop_fields(), at(&Scenario::props), "Props, each at its position.")
      .checked(check_props);
  table.add_read("scatter", scatter_lists(), scatter_props, "Props that a seed places at random.");
  table.add_read(
      "clutter", clutter_values(), strew_clutter,
      "Props that a seed strews along walls and roads and on lawns, where nobody walks.");
  table.add_read("sitters", sitter_values(), read_sitters,
                 "People who sit on benches and at tables for the whole run, and are labeled as "
                 "everybody; default: none.");
}

}  // namespace

const FieldTable<Scenario>& scenario_fields() {
  static const FieldTable<Scenario> fields = [] {
    FieldTable<Scenario> table;
    table.add_schema_name();
    table
        .add("name", "", "", fields::raw({{"type", "string"}, {kOneLine, true}}),
             at(&Scenario::name), "Name for people.")
        .required();
    table.add("description", "", "", any_texts(), at(&Scenario::description),
              "Description for people.");
    add_files(table);
    add_ground(table);
    add_parts(table);
    add_hazards(table);
    return table;
  }();
  return fields;
}

ordered_json extendable_schema(const std::string& title, const std::string& description,
                               const ordered_json& fields) {
  ordered_json schema = fields::document_schema(title, description, fields);
  schema["anyOf"] = {{{"required", {"extends"}}}, {{"required", schema["required"]}}};
  schema.erase("required");
  schema["properties"]["extends"] = {
      {"description",
       "Another file of this folder, with the fields that this one leaves out: fields of objects "
       "replace those of the same name, lists and values replace the whole (RFC 7396)."},
      {"type", "string"}};
  return schema;
}

ordered_json scenario_schema() {
  return extendable_schema("throng scenario",
                           "Ground, buildings, exits and drones of a scenario, and the files of "
                           "its crowd (docs/scenario.md).",
                           scenario_fields().schema());
}

}  // namespace throng::world
