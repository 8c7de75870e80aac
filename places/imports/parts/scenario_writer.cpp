#include "places/imports/parts/scenario_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "crowd/description/builder.h"
#include "crowd/description/menge_files/write.h"
#include "crowd/description/options.h"
#include "places/imports/parts/mesh_text.h"
#include "world/fields/scenario_parts.h"

namespace throng::imports {

namespace fs = std::filesystem;
using crowd::decimals_text;
using crowd::Node;
using crowd::SceneBuilder;
using Eigen::Vector2d;
using nlohmann::json;
namespace describe = crowd::describe;

namespace {

constexpr double kUsualSpeedMps = 1.34;  // Weidmann 1993
constexpr double kGoalBeyondM = 2;
constexpr int kDecimals = 3;  // millimeters are enough, and short

double rounded(double value) { return std::round(value * 1000) / 1000; }
json point(const Vector2d& p) { return {rounded(p.x()), rounded(p.y())}; }

json corners_json(const Corners& corners) {
  json list = json::array();
  for (const Vector2d& corner : corners) list.push_back(point(corner));
  return list;
}

json ground_json(const ImportedScenario& scenario) {
  const world::Rectangle ground = ground_rectangle(scenario);
  json areas = json::array();
  for (const world::GroundArea& area : scenario.areas) {
    areas.push_back({{"corners", corners_json(area.corners)}, {"material", area.material}});
    if (area.kerb) areas.back()["kerb"] = 1;
  }
  json markings = json::array();
  for (const world::Marking& marking : scenario.markings) {
    markings.push_back({{"kind", marking.kind},
                        {"from", point(marking.from)},
                        {"to", point(marking.to)},
                        {"width_m", rounded(marking.width_m)}});
  }
  return {{"min", point(ground.min)},
          {"max", point(ground.max)},
          {"material", scenario.ground_material},
          {"areas", areas},
          {"markings", markings}};
}

json buildings_json(const ImportedScenario& scenario) {
  json buildings = json::array();
  for (world::Building building : scenario.buildings) {
    building.height_m = rounded(building.height_m);
    buildings.push_back(world::building_fields().print(building));
    buildings.back()["footprint"] = corners_json(building.footprint);
  }
  return buildings;
}

json props_json(const ImportedScenario& scenario) {
  json props = json::array();
  for (const world::Prop& prop : scenario.props) {
    props.push_back({{"kind", world::prop_type(prop.kind).name},
                     {"position", point(prop.position)},
                     {"yaw_deg", rounded(prop.yaw_rad / kDegree)},
                     {"scale", rounded(prop.scale)},
                     {"look", prop.look}});
  }
  return props;
}

json exits_json(const ImportedScenario& scenario, const std::vector<Gate>& gates) {
  json exits = json::array();
  for (std::size_t i = 0; i < gates.size(); ++i) {
    const Vector2d out = outward_direction(gates[i], scenario.inside);
    exits.push_back({{"id", fmt::format("exit{}", i + 1)},
                     {"from", point(gates[i].from)},
                     {"to", point(gates[i].to)},
                     {"outward", {out.x(), out.y()}},
                     {"goals", {{0, i}}}});
  }
  return exits;
}

// South of the middle, so that the camera sees the middle.
json drone_json(const ImportedScenario& scenario) {
  const Vector2d middle = 0.5 * (scenario.inside.min + scenario.inside.max);
  const double height = overview_height_m(scenario);
  const Vector2d start = middle - Vector2d(0, 0.8 * height);
  return {{"id", "d1"},
          {"start", {rounded(start.x()), rounded(start.y()), rounded(height)}},
          {"yaw_deg", 90}};
}

json drones_json(const ImportedScenario& scenario) {
  json drones = json::array({drone_json(scenario)});
  for (const ImportedDrone& each : scenario.drones) {
    drones.push_back(
        {{"id", each.id},
         {"start",
          {rounded(each.position.x()), rounded(each.position.y()), rounded(each.position.z())}},
         {"yaw_deg", rounded(each.yaw_rad / kDegree)}});
  }
  return drones;
}

json scenario_json(const ImportedScenario& scenario, const Population& population) {
  json meshes = json::array();
  for (std::size_t i = 0; i < scenario.objects.size(); ++i) {
    meshes.push_back({{"file", mesh_name(scenario, i) + ".obj"}, {"position", {0, 0, 0}}});
  }
  return {
      {"name", scenario.name},
      {"description", scenario.description},
      {"crowd",
       {{"scene", scenario.name + "_scene.xml"}, {"behavior", scenario.name + "_behavior.xml"}}},
      {"ground", ground_json(scenario)},
      {"inside", {{"min", point(scenario.inside.min)}, {"max", point(scenario.inside.max)}}},
      {"exits", exits_json(scenario, population.gates)},
      {"buildings", buildings_json(scenario)},
      {"drones", drones_json(scenario)},
      {"props", props_json(scenario)},
      {"clutter", {{"seed", 1}}},
      {"meshes", meshes}};
}

json job_json(const ImportedScenario& scenario) {
  json drones = json::array();
  for (const ImportedDrone& each : scenario.drones) {
    json drone = {{"id", each.id}};
    if (!each.airframe.is_null()) drone["airframe"] = each.airframe;
    if (!each.camera.is_null()) drone["camera"] = each.camera;
    drones.push_back(std::move(drone));
  }
  if (drones.empty()) drones.push_back({{"id", "d1"}, {"camera", {{"pitch_deg", -50}}}});
  json job = {{"name", scenario.name},
              {"scenario", scenario.name},
              {"quality", "draft"},
              {"drones", drones},
              {"capture", {{"rate_hz", 0.5}, {"from_s", 4}, {"to_s", 30}}}};
  if (!scenario.environment.is_null()) job["environment"] = scenario.environment;
  return job;
}

// As many come in as a scenario of this size with so many people loses, when everybody walks across
// it once (Little's law).
void add_arrivals(const ImportedScenario& scenario, const Population& population,
                  SceneBuilder& scene) {
  constexpr double kInM = 2;
  constexpr double kUntilS = 600;
  const double across_s = (scenario.inside.max - scenario.inside.min).maxCoeff() / kUsualSpeedMps;
  const double total_per_s = static_cast<double>(population.starts.size()) / across_s;
  double shares = 0;
  for (const Gate& gate : population.gates) shares += gate.share;
  for (const Gate& gate : population.gates) {
    const double per_s = total_per_s * gate.share / std::max(shares, 1e-9);
    if (per_s < 1e-4) continue;
    const Vector2d middle = 0.5 * (gate.from + gate.to);
    const Vector2d in = -outward_direction(gate, scenario.inside);
    const Vector2d along = (gate.to - gate.from).normalized();
    std::vector<Vector2d> starts;
    const double half = std::max(0.0, 0.5 * (gate.to - gate.from).norm() - 0.6);
    for (double at = -half; at <= half; at += 0.9)
      starts.emplace_back(middle + kInM * in + at * along);
    Node arrivals = describe::typed("Arrivals", "rate",
                                    {{"per_second", decimals_text(per_s, 4)}, {"end", kUntilS}});
    scene.add_group(
        {"person", "Walk", describe::agents_at(starts, kDecimals), {std::move(arrivals)}});
  }
}

crowd::SceneDescription describe_scene(const ImportedScenario& scenario,
                                       const Population& population) {
  SceneBuilder scene;
  scene.add_profile({.name = "person",
                     .common = {{"max_angle_vel", 360},
                                {"max_neighbors", 10},
                                {"obstacleSet", 1},
                                {"neighbor_dist", 8},
                                {"r", crowd::kAdultRadiusM},
                                {"class", 1},
                                {"pref_speed", kUsualSpeedMps},
                                {"max_speed", 2},
                                {"max_accel", 5}},
                     .properties = {describe::property(
                         "pref_speed", describe::Sampled::normal(kUsualSpeedMps, 0.26))},
                     .models = {describe::model("ORCA", {{"tau", 3}, {"tauObst", 0.4}})}});
  if (!population.starts.empty()) {
    scene.add_group({"person", "Walk", describe::agents_at(population.starts, kDecimals)});
  }
  if (scenario.people_come) add_arrivals(scenario, population, scene);
  std::vector<Corners> obstacles = scenario.obstacles;
  for (const world::Prop& prop : scenario.props) {
    const auto corners = world::prop_footprint(prop);
    obstacles.emplace_back(corners.begin(), corners.end());
  }
  scene.add_obstacles(obstacles, 1, kDecimals);
  return scene.build();
}

crowd::BehaviorDescription describe_behavior(const ImportedScenario& scenario,
                                             const Population& population) {
  std::vector<Node> goals;
  for (const Gate& gate : population.gates) {
    const Vector2d goal =
        0.5 * (gate.from + gate.to) + kGoalBeyondM * outward_direction(gate, scenario.inside);
    const double radius = std::clamp(0.4 * (gate.to - gate.from).norm(), 0.5, 1.5);
    goals.push_back(describe::circle_goal(static_cast<int>(goals.size()), goal, radius, kDecimals));
    goals.back().set({"radius", decimals_text(radius, 2)});
  }
  crowd::BehaviorBuilder behavior;
  behavior.add_goal_set(0, std::move(goals));
  behavior.add_state("Walk", {describe::select_goal("random", 0), describe::velocity("auto")});
  behavior.add_final_state("Gone", {describe::action("leave")});
  behavior.add_transition("Walk", "Gone", describe::condition("goal_reached"));
  crowd::BehaviorDescription description = behavior.build();
  description.root.comment = "A beginning: everybody walks to one of the exits and leaves.";
  return description;
}

}  // namespace

std::string Skipped::text() const {
  std::string where = file;
  if (line > 0) where += fmt::format(":{}", line);
  return fmt::format("{}{}{}: {}", where, where.empty() ? "" : ": ", element, reason);
}

double overview_height_m(const ImportedScenario& scenario) {
  constexpr double kAboveRoofsM = 6;
  constexpr double kMinHeightM = 18;
  constexpr double kMaxHeightM = 60;
  const Vector2d size = scenario.inside.max - scenario.inside.min;
  double height = std::clamp(0.45 * size.maxCoeff(), kMinHeightM, kMaxHeightM);
  for (const world::Building& building : scenario.buildings) {
    height = std::max(height, building.height_m + kAboveRoofsM);
  }
  return height;
}

fs::path write_imported_scenario(const ImportedScenario& scenario, const Population& population,
                                 const fs::path& folder) {
  constexpr int kIndent = 1;
  for (std::size_t i = 0; i < scenario.objects.size(); ++i) {
    const std::string name = mesh_name(scenario, i);
    const MeshText mesh =
        mesh_text(scenario.objects[i], fs::path(name).filename().string() + ".mtl");
    write_file_atomically(folder / (name + ".mtl"), mesh.materials);
    write_file_atomically(folder / (name + ".obj"), mesh.triangles);
  }
  std::string skipped;
  for (const Skipped& one : scenario.skipped) skipped += one.text() + "\n";
  write_file_atomically(folder / (scenario.name + ".skipped.txt"), skipped);
  write_file_atomically(folder / (scenario.name + "_scene.xml"),
                        crowd::to_xml(describe_scene(scenario, population)));
  write_file_atomically(folder / (scenario.name + "_behavior.xml"),
                        crowd::to_xml(describe_behavior(scenario, population)));
  write_file_atomically(folder / (scenario.name + ".job.json"),
                        job_json(scenario).dump(kIndent) + "\n");
  const fs::path file = folder / (scenario.name + ".json");
  write_file_atomically(file, scenario_json(scenario, population).dump(kIndent) + "\n");
  return file;
}

}  // namespace throng::imports
