#include "world/fields/scenario_parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/files/confine.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "base/json/json_describe.h"
#include "world/fields/document_values.h"

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
constexpr std::array<std::pair<const char*, Facade>, 5> kFacades = {{{"plaster", Facade::plaster},
                                                                     {"brick", Facade::brick},
                                                                     {"glass", Facade::glass},
                                                                     {"hedge", Facade::hedge},
                                                                     {"screen", Facade::screen}}};

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

const FieldTable<Building>& building_fields() {
  static const FieldTable<Building> fields = [] {
    std::vector<std::string> words;
    words.reserve(kFacades.size());
    for (const auto& [word, facade] : kFacades) words.emplace_back(word);
    FieldTable<Building> table;
    add_id(table);
    table
        .add_read("footprint", polygons(), set_footprint,
                  "Corners, counter-clockwise from above, none repeated; the edges must not cross.")
        .measured_in("m")
        .required();
    table
        .add("height_m", "", "m", fields::numbers(0.1, kMaxHeightM), at(&Building::height_m),
             "Height; below 2.6 m it is a wall without windows.")
        .required();
    table.add_read(
        "facade", fields::one_of_words(words),
        [](Building& building, const json& value, const FieldLocation& /*place*/) {
          for (const auto& [word, facade] : kFacades) {
            if (value == word) building.facade = facade;
          }
        },
        "Facade; default: plaster or brick, by the building's number.");
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
