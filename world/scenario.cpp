#include "world/scenario.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>

#include "base/error.h"
#include "base/files/confine.h"
#include "base/files/files.h"
#include "base/files/resources.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "base/json/json_text.h"
#include "base/schemas/schemas.h"
#include "base/text/suggest.h"
#include "world/exit_opening.h"
#include "world/exit_overlap.h"
#include "world/extended_document.h"
#include "world/json_reader.h"

namespace throng::world {

namespace fs = std::filesystem;

namespace {

constexpr double kMaxCoordinateM = 100'000;
constexpr double kMaxHeightM = 1'000;
constexpr double kNarrowestExitM = 0.1;
constexpr double kMaxClosingS = 1e6;
constexpr int kMaxId = 1'000'000'000;

class UniqueNames {
 public:
  std::string read(const JsonValue& value) {
    std::string name = value.identifier();
    if (!name.empty() && !seen_.insert(name).second) value.reject("an id that nothing else has");
    return name;
  }

 private:
  std::set<std::string> seen_;
};

GoalRef read_goal(const JsonValue& value) {
  const auto parts = value.tuple(2, "[goal set, goal]");
  if (parts.empty()) return {};
  return {parts[0].integer(0, kMaxId), parts[1].integer(0, kMaxId)};
}

Rectangle read_rectangle(const JsonValue& value) {
  Rectangle area{value["min"].vector2(kMaxCoordinateM), value["max"].vector2(kMaxCoordinateM)};
  if (value["min"].exists() && value["max"].exists() &&
      !(area.min.array() < area.max.array()).all()) {
    value["max"].reject("a corner right of and above \"min\"");
  }
  return area;
}

geometry::Region read_region(const JsonValue& value) {
  if (!value["corners"].exists()) {
    value.fields({"min", "max"}, {"corners"});
    return {read_rectangle(value)};
  }
  value.fields({"corners"}, {});
  geometry::Region region;
  for (const JsonValue& corner : value["corners"].items(3)) {
    region.outline.push_back(corner.vector2(kMaxCoordinateM));
  }
  if (region.outline.size() < 3) return region;
  if (!geometry::is_simple(region.outline)) {
    value["corners"].reject("edges that touch each other",
                            "a polygon whose corners all differ and whose edges do not cross");
  } else if (geometry::signed_area(region.outline) < 0) {
    std::reverse(region.outline.begin(), region.outline.end());
  }
  region.bounds = geometry::bounding_box(region.outline);
  return region;
}

// The side of the exit that leads out: as given, out of the polygon on whose border it lies, or
// away from the middle of the scenario.
Eigen::Vector2d read_outward(const JsonValue& value, const Exit& exit,
                             const geometry::Region& inside) {
  const Eigen::Vector2d along = exit.to - exit.from;
  const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
  if (!value.exists()) {
    constexpr double kBesideM = 0.1;
    const bool is_in_front = inside.contains(exit.middle() - kBesideM * normal);
    const bool is_in_behind = inside.contains(exit.middle() + kBesideM * normal);
    if (!inside.outline.empty() && is_in_front != is_in_behind) {
      return is_in_front ? normal : -normal;
    }
    return normal.dot(exit.middle() - inside.bounds.center()) >= 0 ? normal : -normal;
  }
  const Eigen::Vector2d given = value.vector2(kMaxCoordinateM);
  constexpr double kCosineOfADegree = 0.99985;
  if (std::abs(given.normalized().dot(normal)) < kCosineOfADegree) {
    value.reject("a direction at right angles to the segment from \"from\" to \"to\"");
  }
  return given.dot(normal) >= 0 ? normal : -normal;
}

std::vector<Exit> read_exits(const JsonValue& list, const geometry::Region& inside) {
  std::vector<Exit> exits;
  UniqueNames ids;
  std::set<std::pair<int, int>> claimed;
  const std::vector<JsonValue> items = list.items();
  if (list.is_list_of(0)) list.reject("a list of at least one exit");
  for (const JsonValue& item : items) {
    item.fields({"id", "from", "to"}, {"goals", "outward", "open", "closes_at_s"}, {"shuts_s"});
    Exit exit;
    exit.id = ids.read(item["id"]);
    exit.from = item["from"].vector2(kMaxCoordinateM);
    exit.to = item["to"].vector2(kMaxCoordinateM);
    if (item["from"].exists() && item["to"].exists() && exit.length_m() < kNarrowestExitM) {
      item["to"].reject(fmt::format("an end at least {} m from \"from\"", kNarrowestExitM));
    } else {
      exit.outward = read_outward(item["outward"], exit, inside);
    }
    if (item["open"].exists()) exit.open = item["open"].boolean();
    const JsonValue closes_at = item.renamed("closes_at_s", "shuts_s");
    if (closes_at.exists()) {
      exit.closes_at_s = closes_at.number(0, kMaxClosingS);
      if (!exit.open) closes_at.reject("a time, though the door is never open", "none");
    }
    // A scenario for recorded people has no goals to name.
    const auto goals = item["goals"].exists() ? item["goals"].items(1) : std::vector<JsonValue>();
    for (const JsonValue& goal : goals) {
      exit.goals.push_back(read_goal(goal));
      const GoalRef& ref = exit.goals.back();
      if (!claimed.insert({ref.set, ref.goal}).second) goal.reject("a goal of this exit only");
    }
    exits.push_back(std::move(exit));
  }
  return exits;
}

// Doors at which the same people would count.
void reject_overlaps(const JsonValue& list, const std::vector<Exit>& exits) {
  const std::vector<JsonValue> items = list.items();
  for (const ExitOverlap& overlap : overlapping_exits(exits)) {
    items[overlap.second].reject(
        overlap.found,
        fmt::format("exits that at most touch, none less than {:g} m behind another: those who go "
                    "out there would count at both",
                    kExitDepthM));
  }
}

Facade read_facade(const JsonValue& value) {
  const std::string word = value.text();
  if (word == "plaster") return Facade::plaster;
  if (word == "brick") return Facade::brick;
  if (word == "glass") return Facade::glass;
  if (word == "hedge") return Facade::hedge;
  if (word == "screen") return Facade::screen;
  value.reject("one of: plaster, brick, glass, hedge, screen");
  return Facade::by_id;
}

std::vector<Building> read_buildings(const JsonValue& list) {
  std::vector<Building> buildings;
  UniqueNames ids;
  for (const JsonValue& item : list.items()) {
    item.fields({"id", "footprint", "height_m"}, {"facade"});
    Building building;
    building.id = ids.read(item["id"]);
    building.height_m = item["height_m"].number(0.1, kMaxHeightM);
    if (item["facade"].exists()) building.facade = read_facade(item["facade"]);
    const auto corners = item["footprint"].items(3);
    for (const JsonValue& corner : corners) {
      building.footprint.push_back(corner.vector2(kMaxCoordinateM));
    }
    if (!corners.empty()) {
      if (!geometry::is_simple(building.footprint)) {
        item["footprint"].reject("edges that do not touch each other",
                                 "a polygon whose corners all differ and whose edges do not cross");
      } else if (geometry::signed_area(building.footprint) <= 0) {
        item["footprint"].reject("corners in clockwise order",
                                 "counter-clockwise order, seen from above");
      }
    }
    buildings.push_back(std::move(building));
  }
  return buildings;
}

void check_start(const JsonValue& start, const Eigen::Vector3d& position,
                 const std::vector<Building>& buildings) {
  if (position.z() <= 0) start.reject("a point above the ground (z > 0)");
  for (const Building& building : buildings) {
    if (building.footprint.size() >= 3 && position.z() <= building.height_m &&
        geometry::distance_to(building.footprint, position.head<2>()) == 0) {
      start.reject(fmt::format("a point in building \"{}\"", building.id),
                   "a point outside every building");
    }
  }
}

std::vector<DroneStart> read_drones(const JsonValue& list, const std::vector<Building>& buildings) {
  std::vector<DroneStart> drones;
  UniqueNames ids;
  for (const JsonValue& item : list.items()) {
    item.fields({"id", "start"}, {"yaw_deg", "moves_goal"});
    DroneStart drone;
    drone.id = ids.read(item["id"]);
    drone.position = item["start"].vector3(kMaxCoordinateM);
    if (item["start"].is_list_of(3)) check_start(item["start"], drone.position, buildings);
    if (item["yaw_deg"].exists()) {
      drone.yaw_rad = radians_from_degrees(item["yaw_deg"].number(-360, 360));
    }
    if (item["moves_goal"].exists()) drone.moves_goal = read_goal(item["moves_goal"]);
    drones.push_back(std::move(drone));
  }
  return drones;
}

fs::path read_companion(const JsonValue& value, const fs::path& scenario_file) {
  const std::string name = value.text();
  fs::path path = fs::absolute(scenario_file).parent_path() / name;
  // Before looking whether it is there, which is nobody's business.
  if (value.exists() && !Confinement::allows(path)) {
    value.reject(fmt::format("\"{}\", which lies elsewhere", name),
                 "a file that came with the scenario");
    return {};
  }
  if (value.exists() && !name.empty() && !fs::is_regular_file(path)) {
    value.reject(fmt::format("\"{}\", which does not exist beside the scenario", name),
                 "the name of a file");
  }
  return path.lexically_normal();
}

/// A mesh is an instance like a prop, so its class is one of theirs.
SemanticClass read_mesh_class(const JsonValue& value) {
  const auto known = semantic_class_named(value.text());
  if (known && semantic_class_info(*known).group == SemanticGroup::prop) return *known;
  std::vector<std::string_view> names;
  for (const SemanticClassInfo& info : semantic_classes()) {
    if (info.group == SemanticGroup::prop) names.push_back(info.name);
  }
  value.reject(fmt::format("one of: {}", fmt::join(names, ", ")));
  return SemanticClass::object;
}

std::vector<PlacedMesh> read_meshes(const JsonValue& list, const fs::path& scenario_file) {
  constexpr double kMinScale = 1e-4;
  constexpr double kMaxScale = 1e4;
  std::vector<PlacedMesh> meshes;
  for (const JsonValue& item : list.items()) {
    item.fields({"file", "position"}, {"yaw_deg", "scale", "class"});
    PlacedMesh mesh;
    const fs::path name = item["file"].text();
    if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end()) {
      item["file"].reject("the name of a file in the scenario's folder");
    } else {
      mesh.file = read_companion(item["file"], scenario_file);
    }
    mesh.position = item["position"].vector3(kMaxCoordinateM);
    if (item["yaw_deg"].exists()) {
      mesh.yaw_rad = radians_from_degrees(item["yaw_deg"].number(-360, 360));
    }
    if (item["scale"].exists()) mesh.scale = item["scale"].number(kMinScale, kMaxScale);
    if (item["class"].exists()) mesh.semantic_class = read_mesh_class(item["class"]);
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

std::vector<int> read_disaster_agents(const JsonValue& list) {
  std::vector<int> agents;
  for (const JsonValue& item : list.items()) {
    const int agent = item.integer(0, kMaxId);
    if (std::find(agents.begin(), agents.end(), agent) != agents.end()) {
      item.reject("every agent once");
    }
    agents.push_back(agent);
  }
  return agents;
}

}  // namespace

Scenario load_scenario(const fs::path& file, std::string id) {
  const ExtendedDocument document = read_extended(file, file.string());
  return read_with_files(document,
                         [&] { return parse_scenario(document.whole, file, std::move(id)); });
}

Scenario parse_scenario(const nlohmann::json& document, const fs::path& file, std::string id) {
  const std::string source = file.string();
  std::vector<Problem> problems;
  const JsonValue root(document, source, problems);
  root.fields({"name", "ground", "inside", "exits"},
              {"crowd", "description", "buildings", "drones", "disaster_agents", "disasters",
               "guides_alert", "meshes", "props", "scatter"});
  const bool has_crowd = root["crowd"].exists();
  if (has_crowd) root["crowd"].fields({"scene", "behavior"}, {"model"});
  root["ground"].fields({"min", "max", "material"}, {"areas", "markings"});

  Scenario scenario;
  scenario.id = std::move(id);
  scenario.name = root["name"].text();
  scenario.description = root["description"].text();
  if (has_crowd) {
    scenario.scene_file = read_companion(root["crowd"]["scene"], file);
    scenario.behavior_file = read_companion(root["crowd"]["behavior"], file);
  }
  if (root["crowd"]["model"].exists()) scenario.crowd_model = root["crowd"]["model"].text();
  scenario.ground = read_rectangle(root["ground"]);
  scenario.ground_material = read_ground_material(root["ground"]["material"]);
  scenario.inside = read_region(root["inside"]);
  const std::size_t problems_before = problems.size();
  scenario.exits = read_exits(root["exits"], scenario.inside);
  if (problems.size() == problems_before) reject_overlaps(root["exits"], scenario.exits);
  scenario.buildings = read_buildings(root["buildings"]);
  scenario.drones = read_drones(root["drones"], scenario.buildings);
  scenario.props = read_props(root["props"], root["scatter"], scenario);
  scenario.placed_props = root["props"].items().size();
  scenario.meshes = read_meshes(root["meshes"], file);
  scenario.areas = read_ground_areas(root["ground"]["areas"]);
  scenario.markings = read_markings(root["ground"]["markings"]);
  scenario.disaster_agents = read_disaster_agents(root["disaster_agents"]);
  scenario.disasters = read_disasters(root["disasters"]);
  for (const Disaster& disaster : scenario.disasters) {
    std::vector<int>& agents = scenario.disaster_agents;
    if (std::find(agents.begin(), agents.end(), disaster.agent) == agents.end()) {
      agents.push_back(disaster.agent);
    }
  }
  if (root["guides_alert"].exists()) scenario.guides_alert = root["guides_alert"].boolean();
  schemas::add_schema_problems(schemas::Kind::scenario, document, source, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  trim_to_openings(scenario.buildings, scenario.exits);
  nlohmann::json kept = document;
  for (const char* field : {"crowd", "$schema"}) kept.erase(field);
  scenario.document = kept.dump();
  return scenario;
}

}  // namespace throng::world
