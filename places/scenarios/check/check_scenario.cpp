#include "places/scenarios/check/check_scenario.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "base/geometry/triangulate.h"
#include "places/scenarios/check/sufferers.h"

namespace throng::scenarios {

using Eigen::Vector2d;
using world::Building;
using world::Exit;
using world::Scenario;

namespace {

using Outline = std::vector<Vector2d>;

/// The part of an outline to the left of the line from a to b.
Outline cut_left(const Outline& outline, const Vector2d& a, const Vector2d& b) {
  return geometry::clipped(outline,
                           [&](const Vector2d& p) { return -geometry::cross(b - a, p - a); });
}

double overlap_m2(const Building& a, const Building& b) {
  double area = 0;
  for (const auto& one : geometry::triangulate(a.footprint)) {
    for (const auto& other : geometry::triangulate(b.footprint)) {
      Outline shared = {a.footprint[one[0]], a.footprint[one[1]], a.footprint[one[2]]};
      for (std::size_t i = 0; i < other.size() && !shared.empty(); ++i) {
        shared = cut_left(shared, b.footprint[other[i]], b.footprint[other[(i + 1) % 3]]);
      }
      if (shared.size() >= 3) area += geometry::signed_area(shared);
    }
  }
  return area;
}

}  // namespace

void check_sizes(const Scenario& scenario, Findings& findings) {
  constexpr double kMinSizeM = 3;
  constexpr double kMaxSizeM = 20'000;
  constexpr double kMaxExitWidthM = 200;
  constexpr double kMaxHeightM = 500;
  const Vector2d inside = scenario.inside.bounds.max - scenario.inside.bounds.min;
  if (inside.minCoeff() < kMinSizeM || inside.maxCoeff() > kMaxSizeM) {
    findings.error("/inside", fmt::format("{:.4g} m by {:.4g} m", inside.x(), inside.y()),
                   fmt::format("a scenario of {} m to {} m", kMinSizeM, kMaxSizeM),
                   "give all lengths in meters; was this exported in millimeters or kilometers?");
  }
  const Vector2d ground = scenario.ground.max - scenario.ground.min;
  if (ground.maxCoeff() > 2 * kMaxSizeM) {
    findings.error("/ground", fmt::format("{:.4g} m by {:.4g} m", ground.x(), ground.y()),
                   fmt::format("at most {} m", 2 * kMaxSizeM),
                   "give all lengths in meters, and draw no more ground than a camera sees");
  }
  for (std::size_t i = 0; i < scenario.exits.size(); ++i) {
    if (scenario.exits[i].length_m() <= kMaxExitWidthM) continue;
    findings.error(fmt::format("/exits/{}", i),
                   fmt::format("exit \"{}\" {:.4g} m wide", scenario.exits[i].id,
                               scenario.exits[i].length_m()),
                   fmt::format("a door of at most {} m", kMaxExitWidthM),
                   "give all lengths in meters, or make several exits of it");
  }
  for (std::size_t i = 0; i < scenario.buildings.size(); ++i) {
    if (scenario.buildings[i].height_m <= kMaxHeightM) continue;
    findings.warning(fmt::format("/buildings/{}/height_m", i),
                     fmt::format("{:.4g} m", scenario.buildings[i].height_m),
                     fmt::format("at most {} m", kMaxHeightM), "give heights in meters");
  }
}

void check_buildings(const Scenario& scenario, Findings& findings) {
  constexpr double kTouchM2 = 0.01;  // walls that meet
  std::vector<world::Rectangle> bounds;
  bounds.reserve(scenario.buildings.size());
  for (const Building& building : scenario.buildings)
    bounds.push_back(geometry::bounding_box(building.footprint));
  for (std::size_t i = 0; i < scenario.buildings.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!bounds[i].meets(bounds[j])) continue;
      const double area = overlap_m2(scenario.buildings[i], scenario.buildings[j]);
      if (area <= kTouchM2) continue;
      findings.error(fmt::format("/buildings/{}", i),
                     fmt::format("\"{}\" and \"{}\" have {:.3g} m² in common",
                                 scenario.buildings[i].id, scenario.buildings[j].id, area),
                     "buildings that at most touch",
                     "move one of them, or make one building with both outlines");
    }
  }
}

void check_drones(const Scenario& scenario, Findings& findings) {
  constexpr double kClearM = 0.6;  // of the largest shipped airframe and some more
  for (std::size_t i = 0; i < scenario.drones.size(); ++i) {
    const world::DroneStart& drone = scenario.drones[i];
    const std::string where = fmt::format("/drones/{}/start", i);
    for (const Building& building : scenario.buildings) {
      if (drone.position.z() > building.height_m + kClearM ||
          geometry::distance_to(building.footprint, drone.position.head<2>()) > kClearM) {
        continue;
      }
      findings.error(
          where, fmt::format("drone \"{}\" in or against building \"{}\"", drone.id, building.id),
          fmt::format("at least {} m of air around it", kClearM),
          "start it farther away, or above the roof");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if ((scenario.drones[j].position - drone.position).norm() > 2 * kClearM) continue;
      findings.error(where,
                     fmt::format("drones \"{}\" and \"{}\" at the same position",
                                 scenario.drones[j].id, drone.id),
                     fmt::format("starts {} m apart", 2 * kClearM), "move one of them");
    }
  }
}

void check_people(const Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                  Findings& findings) {
  // Beside a wall, the nearest free cell may be the next one, which on large grounds is far.
  const double slack_m = std::max(0.5, 1.5 * static_cast<double>(routes.grid.cell_m));
  Sufferers in_walls(loaded);
  Sufferers in_buildings(loaded);
  Sufferers in_props(loaded);
  Sufferers locked_in(loaded);
  std::size_t people = 0;
  std::vector<world::Rectangle> bounds;
  for (const Building& building : scenario.buildings)
    bounds.push_back(geometry::bounding_box(building.footprint));
  for (std::size_t agent = 0; agent < loaded.count(); ++agent) {
    if (!is_to_arrive_or_there(loaded, agent)) continue;
    ++people;
    const Vector2d at = loaded.start(agent);
    if (loaded.crowd.obstacles.is_solid(at.cast<float>(),
                                        loaded.crowd.agents.obstacle_mask[agent])) {
      in_walls.add(agent, at, "in an obstacle");
      continue;
    }
    for (std::size_t i = 0; i < scenario.buildings.size(); ++i) {
      if (bounds[i].contains(at) &&
          geometry::distance_to(scenario.buildings[i].footprint, at) == 0) {
        in_buildings.add(agent, at, fmt::format("in building \"{}\"", scenario.buildings[i].id));
      }
    }
    for (std::size_t i = 0; i < scenario.props.size(); ++i) {
      if ((scenario.props[i].position - at).squaredNorm() < 400 &&
          world::distance_to(scenario.props[i], at) == 0) {
        in_props.add(agent, at,
                     fmt::format("in the {} at {}", world::prop_type(scenario.props[i].kind).name,
                                 point_text(scenario.props[i].position)));
      }
    }
    if (routes.cell_at(at) == Routes::kNone) continue;  // outside: nothing to escape from
    const int cell = routes.walkable_near(at, slack_m);
    if (cell == Routes::kNone ||
        routes.nearest_exit[static_cast<std::size_t>(cell)] == Routes::kNone) {
      locked_in.add(agent, at, "with no way to any open exit");
    }
  }
  if (people == 0) {
    findings.error(findings.either("/people", "/crowd/scene"), "nobody",
                   "at least one agent who is a person",
                   findings.either("add \"groups\", \"lines\" or \"sources\"",
                                   "add an <AgentGroup> to the scene file"));
  }
  const std::string move = findings.either("move the people, or the building or prop",
                                           "move the generator of these agents, or the obstacle");
  if (in_walls.any()) {
    findings.error(in_walls.where(), in_walls.text(), "people on free ground", move);
  }
  if (in_buildings.any()) {
    findings.error(in_buildings.where(), in_buildings.text(), "people outside of buildings", move);
  }
  if (in_props.any()) {
    findings.error(in_props.where(), in_props.text(), "people beside the props",
                   "move the prop or the people");
  }
  if (locked_in.any()) {
    findings.error(locked_in.where(), locked_in.text(),
                   "ground from which an open exit can be reached",
                   "open the walls, or add an exit there");
  }
}

void check_walls(const Scenario& scenario, const Routes& routes, Findings& findings) {
  for (std::size_t i = 0; i < scenario.buildings.size(); ++i) {
    const Building& building = scenario.buildings[i];
    std::size_t free = 0;
    std::size_t all = 0;
    for (const auto& triangle : geometry::triangulate(building.footprint)) {
      const Vector2d middle = (building.footprint[triangle[0]] + building.footprint[triangle[1]] +
                               building.footprint[triangle[2]]) /
                              3;
      const int cell = routes.cell_at(middle);
      if (cell == Routes::kNone) continue;
      ++all;
      const auto index = static_cast<std::size_t>(cell);
      if (routes.grid.walkable[index] != 0 && routes.nearest_exit[index] != Routes::kNone) ++free;
    }
    if (free == 0) continue;
    findings.warning(fmt::format("/buildings/{}", i),
                     fmt::format("\"{}\", which people walk through: the scene file has no "
                                 "obstacle there ({} of {} points)",
                                 building.id, free, all),
                     "an <Obstacle> with the footprint's corners",
                     "add the footprint to the scene's <ObstacleSet>");
  }
}

void check_ground(const Scenario& scenario, const Routes& routes, Findings& findings) {
  constexpr double kWorthNamingM2 = 1;  // less is a corner that the grid draws too roughly
  if (std::none_of(routes.reached_from_exit.begin(), routes.reached_from_exit.end(),
                   [](std::uint8_t reached) { return reached != 0; })) {
    return;  // the exits' own findings say more
  }
  std::size_t cells = 0;
  Vector2d first = Vector2d::Zero();
  for (std::size_t cell = 0; cell < routes.nearest_exit.size(); ++cell) {
    if (routes.grid.walkable[cell] == 0 || routes.nearest_exit[cell] != Routes::kNone) continue;
    const Vector2d at = routes.cell_center(static_cast<int>(cell));
    if (!scenario.inside.contains(at)) continue;
    if (cells++ == 0) first = at;
  }
  const double area = static_cast<double>(cells) * routes.grid.cell_m * routes.grid.cell_m;
  if (area < kWorthNamingM2) return;
  findings.warning(findings.either("/inside", "/crowd/scene"),
                   fmt::format("{:.3g} m² of free ground, for example at {}, from where no open "
                               "exit can be reached",
                               area, point_text(first)),
                   "ground that people can leave",
                   findings.either("fill it with a building, or open a way out",
                                   "fill it with an obstacle or open a way out"));
}

}  // namespace throng::scenarios
