#include "world/fields/scenario_parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/compute/srgb.h"
#include "base/files/confine.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "base/json/json_describe.h"
#include "world/fields/document_values.h"
#include "world/fields/paint_values.h"

namespace throng::world {

namespace fs = std::filesystem;
using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMaxHeightM = 1'000;
constexpr double kMinMeshScale = 1e-4;
constexpr double kMaxMeshScale = 1e4;
/// A word of files and its value.
template <typename Value>
using Word = std::pair<const char*, Value>;

constexpr std::array<Word<Facade>, 12> kFacades = {{{"plaster", Facade::plaster},
                                                    {"brick", Facade::brick},
                                                    {"glass", Facade::glass},
                                                    {"hedge", Facade::hedge},
                                                    {"screen", Facade::screen},
                                                    {"historic", Facade::historic},
                                                    {"modern", Facade::modern},
                                                    {"concrete", Facade::concrete},
                                                    {"warehouse", Facade::warehouse},
                                                    {"blank", Facade::blank},
                                                    {"railing", Facade::railing},
                                                    {"fence", Facade::fence}}};

constexpr std::array<Word<RoofKind>, 9> kRoofKinds = {{{"flat", RoofKind::flat},
                                                       {"gabled", RoofKind::gabled},
                                                       {"hipped", RoofKind::hipped},
                                                       {"half_hipped", RoofKind::half_hipped},
                                                       {"mansard", RoofKind::mansard},
                                                       {"shed", RoofKind::shed},
                                                       {"sawtooth", RoofKind::sawtooth},
                                                       {"pyramid", RoofKind::pyramid},
                                                       {"dome", RoofKind::dome}}};

constexpr std::array<Word<Covering>, 6> kCoverings = {{{"gravel", Covering::gravel},
                                                       {"tiles", Covering::tiles},
                                                       {"slate", Covering::slate},
                                                       {"metal", Covering::metal},
                                                       {"grass", Covering::grass},
                                                       {"felt", Covering::felt}}};

/// Adds a field whose values are words of a table; default: by the object's number.
template <typename Object, typename Words, typename Access>
void add_choice(FieldTable<Object>& table, const char* name, const Words& words, Access access,
                std::string help) {
  std::vector<std::string> names;
  names.reserve(words.size());
  for (const auto& [word, value] : words) names.emplace_back(word);
  table.add(
      name, "", "", fields::one_of_words(names),
      [&words, access](const Object& object) {
        for (const auto& [word, choice] : words) {
          if (access(object) == choice) return json(word);
        }
        return json();
      },
      [&words, access](Object& object, const json& value, const FieldLocation& /*place*/) {
        for (const auto& [word, choice] : words) {
          if (value == word) access(object) = choice;
        }
      },
      std::move(help));
}

/// Adds a color such as "#a05030", in sRGB.
template <typename Object, typename Access>
void add_paint(FieldTable<Object>& table, Access access, std::string help) {
  table.add(
      "color", "", "", paints(),
      [access](const Object& object) {
        return access(object) ? json(hex_from_paint(*access(object))) : json();
      },
      [access](Object& object, const json& value, const FieldLocation& /*place*/) {
        access(object) = paint_from_hex(value.get_ref<const std::string&>());
      },
      std::move(help));
}

/// Adds an angle in degrees that may be missing.
template <typename Object, typename Access>
void add_angle(FieldTable<Object>& table, const char* name, fields::Values values, Access access,
               std::string help) {
  table.add(
      name, "", "°", std::move(values),
      [access](const Object& object) {
        constexpr double kDecimals = 100;
        if (!access(object)) return json();
        return json(std::round(kDecimals * *access(object) / kDegree) / kDecimals);
      },
      [access](Object& object, const json& value, const FieldLocation& /*place*/) {
        access(object) = radians_from_degrees(value.get<double>());
      },
      std::move(help));
}

/// The heading of a part in degrees.
template <typename Part>
void add_yaw(FieldTable<Part>& table, std::string help) {
  table
      .add_read(
          "yaw_deg", headings_deg(),
          [](Part& part, const json& value, const FieldLocation& /*place*/) {
            part.yaw_rad = radians_from_degrees(value.get<double>());
          },
          std::move(help))
      .measured_in("°")
      .with_default(0);
}

void set_footprint(Building& building, const json& value, const FieldLocation& place) {
  building.footprint = read_polygon(value, place);
  if (!place.has_problem() && geometry::signed_area(building.footprint) <= 0) {
    place.reject("corners in clockwise order", "counter-clockwise order, seen from above");
  }
}

}  // namespace

namespace {

const FieldTable<Roof>& roof_fields() {
  static const FieldTable<Roof> fields = [] {
    FieldTable<Roof> table;
    add_choice(table, "kind", kRoofKinds, at(&Roof::kind),
               "Shape; default: one that suits the building, by its number.");
    table.add("height_m", "", "m", fields::numbers(0, kMaxHeightM), at(&Roof::height_m),
              "Height between eaves and ridge, which is part of the building's; default: by the "
              "pitch.");
    add_angle(table, "pitch_deg", fields::numbers(5, 75), at(&Roof::pitch_rad),
              "Slope of the roof; default: a usual one of its kind.");
    add_choice(table, "material", kCoverings, at(&Roof::covering),
               "Covering; default: a usual one of the kind.");
    add_paint(table, at(&Roof::paint), "Color of the covering; default: a usual one.");
    add_angle(table, "falls_deg", headings_deg(), at(&Roof::falls_rad),
              "Direction in which the slope of a shed, or one of a gabled roof, falls, from +x; "
              "default: across the longest wall.");
    return table;
  }();
  return fields;
}

}  // namespace

const FieldTable<Building>& building_fields() {
  static const FieldTable<Building> fields = [] {
    FieldTable<Building> table;
    add_id(table);
    table
        .add_read("footprint", polygons(), set_footprint,
                  "Corners, counter-clockwise from above, none repeated; the edges must not cross.")
        .measured_in("m")
        .required();
    table
        .add("height_m", "", "m", fields::numbers(0.1, kMaxHeightM), at(&Building::height_m),
             "Height with the roof; below 2.6 m it is a wall without windows.")
        .required();
    add_choice(table, "facade", kFacades, at(&Building::facade),
               "Facade; default: by the building's number, so that neighbors differ.");
    add_paint(table, at(&Building::paint), "Color of the walls; default: a usual one.");
    table.group("roof", "", "The roof.").without_default();
    table.add_all("roof", roof_fields(), at(&Building::roof));
    return table;
  }();
  return fields;
}

const FieldTable<DroneStart>& drone_fields() {
  static const FieldTable<DroneStart> fields = [] {
    FieldTable<DroneStart> table;
    add_id(table);
    table
        .add("start", "", "m", points_in_space(), at(&DroneStart::position),
             "Position of the drone when a run begins: x to the east, y to the north, z up.")
        .required();
    add_yaw(table, "Heading from +x, counter-clockwise.");
    table.add_read(
        "moves_goal", goals(),
        [](DroneStart& drone, const json& value, const FieldLocation& /*place*/) {
          drone.moves_goal = goal_named(value);
        },
        "Goal of the behavior file, [goal set, goal], that follows the drone over the ground.");
    return table;
  }();
  return fields;
}

namespace {

void check_start(const Eigen::Vector3d& position, const std::vector<Building>& buildings,
                 const FieldLocation& place) {
  if (position.z() <= 0) {
    place.reject(describe(fields::value_json(position)), "a point above the ground (z > 0)");
  }
  for (const Building& building : buildings) {
    if (building.footprint.size() >= 3 && position.z() <= building.height_m &&
        geometry::distance_to(building.footprint, position.head<2>()) == 0) {
      place.reject(fmt::format("a point in building \"{}\"", building.id),
                   "a point outside every building");
    }
  }
}

/// A mesh is an instance like a prop, so its class is one of theirs.
std::vector<std::string> mesh_classes() {
  std::vector<std::string> names;
  for (const SemanticClassInfo& info : semantic_classes()) {
    if (info.group == SemanticGroup::prop) names.emplace_back(info.name);
  }
  return names;
}

void set_mesh_file(PlacedMesh& mesh, const json& value, const FieldLocation& place) {
  const fs::path name = value.get<std::string>();
  if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end()) {
    place.reject(describe(value), "the name of a file in the scenario's folder");
  } else {
    mesh.file = read_companion(value, place);
  }
}

}  // namespace

const FieldTable<PlacedMesh>& mesh_fields() {
  static const FieldTable<PlacedMesh> fields = [] {
    FieldTable<PlacedMesh> table;
    table
        .add_read("file", any_texts(), set_mesh_file,
                  "Name of the file in the scenario's folder: glTF, OBJ and other formats of "
                  "assimp; y up. Its materials give the colors; textures are not rendered. The "
                  "lowest 30 m cast shadows.")
        .required();
    table
        .add("position", "", "m", points_in_space(), at(&PlacedMesh::position),
             "Position of the mesh.")
        .required();
    add_yaw(table, "Rotation about the vertical, counter-clockwise.");
    table.add("scale", "", "", fields::numbers(kMinMeshScale, kMaxMeshScale),
              at(&PlacedMesh::scale), "Meters per unit of the file.");
    table
        .add_read(
            "class", fields::one_of_words(mesh_classes()),
            [](PlacedMesh& mesh, const json& value, const FieldLocation& /*place*/) {
              mesh.semantic_class = *semantic_class_named(value.get<std::string>());
            },
            "Semantic class of its surfaces.")
        .with_default("object");
    return table;
  }();
  return fields;
}

fs::path read_companion(const json& value, const FieldLocation& place) {
  const auto& name = value.get_ref<const std::string&>();
  fs::path path = fs::absolute(place.source).parent_path() / name;
  // Before looking whether it is there, which is nobody's business.
  if (!Confinement::allows(path)) {
    place.reject(fmt::format("\"{}\", which lies elsewhere", name),
                 "a file that came with the scenario");
    return {};
  }
  if (!name.empty() && !fs::is_regular_file(path)) {
    place.reject(fmt::format("\"{}\", which does not exist beside the scenario", name),
                 "the name of a file");
  }
  return path.lexically_normal();
}

void check_drones(Scenario& scenario, const json& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const FieldLocation item = place.below(i);
    if (!has_valid(list[i], "start", item)) continue;
    check_start(scenario.drones[i].position, scenario.buildings, item.below("start"));
  }
  check_ids(scenario.drones, place);
}

}  // namespace throng::world
