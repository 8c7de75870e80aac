#include "places/scenarios/plan/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "places/scenarios/check/survey.h"
#include "places/scenarios/plan/plan_drawing.h"
#include "world/stand_seats.h"

namespace throng::scenarios {

using drawing::Color;
using Eigen::Vector2d;
using world::Scenario;

namespace {

Color ground_color(const std::string& material) {
  static const std::map<std::string, std::array<std::uint8_t, 3>> kMaterials = {
      {"pavers", {236, 232, 226}},   {"asphalt", {214, 214, 216}}, {"grass", {206, 224, 190}},
      {"concrete", {228, 228, 226}}, {"dirt", {224, 210, 188}},    {"water", {176, 206, 230}}};
  const auto found = kMaterials.find(material);
  return {found != kMaterials.end() ? found->second : std::array<std::uint8_t, 3>{240, 240, 240}};
}

void draw_ground(const Scenario& scenario, Sheet& sheet) {
  const world::Rectangle& all = scenario.ground;
  sheet.polygon(std::array{all.min, Vector2d(all.max.x(), all.min.y()), all.max,
                           Vector2d(all.min.x(), all.max.y())},
                ground_color(scenario.ground_material), drawing::kTransparent);
  for (const world::GroundArea& area : scenario.areas) {
    sheet.polygon(area.corners, ground_color(area.material), drawing::kTransparent);
  }
  constexpr Color kPaint{{255, 255, 255}};
  constexpr Color kBallast{{190, 184, 176}};
  constexpr double kBallastM = 4;
  for (const world::Marking& marking : scenario.markings) {
    const Vector2d along = (marking.to - marking.from).normalized();
    const bool is_track = marking.kind == "track";
    const Vector2d side =
        0.5 * (is_track ? kBallastM : marking.width_m) * Vector2d(-along.y(), along.x());
    const std::array<Vector2d, 4> strip = {marking.from - side, marking.to - side,
                                           marking.to + side, marking.from + side};
    if (marking.kind == "pitch") {
      sheet.polygon(strip, ground_color("grass"), kPaint);
    } else {
      sheet.polygon(strip, is_track ? kBallast : kPaint, drawing::kTransparent);
    }
  }
  constexpr Color kEdge{{120, 120, 120}, 0.5};
  sheet.polygon(scenario.inside.corners(), drawing::kTransparent, kEdge);
}

void draw_props(const Scenario& scenario, Sheet& sheet) {
  for (const world::Stand& stand : scenario.stands) {
    if (!stand.band.empty()) continue;
    sheet.polygon(world::stand_outline(stand), colors::kBuilding, colors::kInk);
  }
  for (const world::Building& building : scenario.buildings) {
    sheet.polygon(building.footprint, colors::kBuilding, colors::kInk);
  }
  for (std::size_t i = 0; i + scenario.strewn_props < scenario.props.size(); ++i) {
    sheet.polygon(world::prop_footprint(scenario.props[i]), colors::kProp, drawing::kTransparent);
  }
}

void name_buildings(const Scenario& scenario, Sheet& sheet) {
  for (const world::Building& building : scenario.buildings) {
    Vector2d middle = Vector2d::Zero();
    for (const Vector2d& corner : building.footprint) middle += corner;
    sheet.label(middle / static_cast<double>(building.footprint.size()), {-12, 4}, building.id,
                colors::kInk);
  }
}

void draw_obstacles(const crowd::Obstacles& obstacles, Sheet& sheet) {
  for (const crowd::Segment& segment : obstacles.segments()) {
    sheet.line(std::array<Vector2d, 2>{segment.begin.cast<double>(), segment.end.cast<double>()},
               colors::kObstacle, 1.2);
  }
}

constexpr double kDoorPx = 5;

std::string capacity_text(const world::Exit& exit) {
  return exit.capacity ? fmt::format(", {}", exit.capacity->text()) : "";
}

void draw_inner_doors(const Scenario& scenario, Sheet& sheet) {
  for (const world::InnerDoor& door : scenario.doors) {
    sheet.line(std::array{door.from, door.to}, colors::kOpenExit, kDoorPx);
    sheet.label(door.to, {4, -6}, fmt::format("{}, {}", door.id, door.capacity.text()),
                colors::kOpenExit);
  }
}

void draw_exits(const Scenario& scenario, Sheet& sheet) {
  for (const world::Exit& exit : scenario.exits) {
    const Color& color = exit.open ? colors::kOpenExit : colors::kClosedExit;
    sheet.line(std::array{exit.from, exit.to}, color, kDoorPx);
    // Beyond the door, where nothing else is written.
    constexpr double kBesideM = 1.2;
    sheet.label(exit.middle() + kBesideM * exit.outward, {exit.outward.x() < -0.5 ? -90.0 : 4.0, 4},
                fmt::format("{} {:.3g} m{}", exit.id, exit.width_m(), capacity_text(exit)), color);
  }
}

/// The exits' goals and the others within the plan; a goal that waits to be moved is far away.
void draw_goals(const Scenario& scenario, const crowd::Goals& goals, Sheet& sheet) {
  for (int i = 0; i < goals.count(); ++i) {
    const crowd::Goal& goal = goals[i];
    const Vector2d center = goal.shape->center().cast<double>();
    if (!scenario.ground.contains(center)) continue;
    constexpr double kGoalPx = 2.5;
    sheet.dot(center, kGoalPx, colors::kGoal);
  }
}

/// How many people come at each point, by meter.
using Arrivals = std::map<std::pair<long, long>, int>;

/// Takes the points out that hang together with the first, none more than 2 m from the next, and
/// says how many people come at them.
int take_source(Arrivals& arrivals) {
  int people = 0;
  std::vector<std::pair<long, long>> reached = {arrivals.begin()->first};
  while (!reached.empty()) {
    const auto [x, y] = reached.back();
    reached.pop_back();
    for (long dx = -2; dx <= 2; ++dx) {
      for (long dy = -2; dy <= 2; ++dy) {
        const auto found = arrivals.find({x + dx, y + dy});
        if (found == arrivals.end()) continue;
        people += found->second;
        reached.push_back(found->first);
        arrivals.erase(found);
      }
    }
  }
  return people;
}

void draw_sources(Arrivals arrivals, Sheet& sheet) {
  constexpr double kSourcePx = 4;
  const auto at = [](const std::pair<long, long>& point) {
    return Vector2d(static_cast<double>(point.first), static_cast<double>(point.second));
  };
  for (const auto& [point, count] : arrivals) sheet.dot(at(point), kSourcePx, colors::kSource);
  while (!arrivals.empty()) {
    const Vector2d first = at(arrivals.begin()->first);
    sheet.label(first, {8, -6}, fmt::format("{} enter", take_source(arrivals)), colors::kSource);
  }
}

void draw_people(const LoadedCrowd& loaded, Sheet& sheet) {
  constexpr std::size_t kMaxDots = 3000;
  constexpr double kPersonPx = 1.6;
  const std::size_t stride = 1 + loaded.count() / kMaxDots;
  Arrivals arrivals;
  for (std::size_t agent = 0; agent < loaded.count(); ++agent) {
    const Vector2d at = loaded.start(agent);
    if (loaded.is_person[agent] == 0) {
      constexpr double kDangerPx = 7;
      sheet.dot(at, kDangerPx, colors::kDanger);
    } else if (loaded.crowd.agents.awaited[agent] != 0) {
      ++arrivals[{std::lround(at.x()), std::lround(at.y())}];
    } else if (agent % stride == 0) {
      sheet.dot(at, kPersonPx, colors::kPerson);
    }
  }
  draw_sources(std::move(arrivals), sheet);
}

/// For each exit an arrow from the middle of those who are there from the start and have it as
/// their nearest, and their number.
void draw_flows(const Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                Sheet& sheet) {
  struct Flow {
    Vector2d sum = Vector2d::Zero();
    int people = 0;
  };
  std::vector<Flow> flows(scenario.exits.size());
  int all = 0;
  for (std::size_t agent = 0; agent < loaded.count(); ++agent) {
    if (loaded.is_person[agent] == 0 || loaded.crowd.agents.awaited[agent] != 0) continue;
    const Vector2d at = loaded.start(agent);
    const int cell = routes.walkable_near(at, 1);
    const int exit =
        cell == Routes::kNone ? Routes::kNone : routes.nearest_exit[static_cast<std::size_t>(cell)];
    if (exit == Routes::kNone) continue;
    flows[static_cast<std::size_t>(exit)].sum += at;
    ++flows[static_cast<std::size_t>(exit)].people;
    ++all;
  }
  constexpr double kMaxWidthPx = 24;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    if (flows[i].people == 0) continue;
    const Vector2d from = flows[i].sum / flows[i].people;
    const Vector2d to = scenario.exits[i].middle();
    if ((to - from).norm() < 1) continue;
    sheet.line(std::array{from, to}, colors::kFlow, 1 + kMaxWidthPx * flows[i].people / all, true);
    sheet.label(0.5 * (from + to), {6, -4}, fmt::format("nearest exit for {}", flows[i].people),
                colors::kOpenExit);
  }
}

void draw_start(const std::string& id, const Eigen::Vector3d& start, Sheet& sheet) {
  constexpr double kDroneM = 1.2;
  sheet.ring(start.head<2>(), kDroneM, colors::kDrone);
  sheet.label(start.head<2>(), {8, 16}, fmt::format("{}, {:.3g} m up", id, start.z()),
              colors::kDrone);
}

void draw_drones(const Scenario& scenario, Sheet& sheet) {
  for (const world::DroneStart& drone : scenario.drones) {
    const Vector2d at = drone.position.head<2>();
    constexpr double kHeadingM = 3;
    const Vector2d heading(std::cos(drone.yaw_rad), std::sin(drone.yaw_rad));
    sheet.line(std::array<Vector2d, 2>{at, at + kHeadingM * heading}, colors::kDrone, 2, true);
    draw_start(drone.id, drone.position, sheet);
  }
}

void draw_paths(std::span<const world::DronePath> paths, Sheet& sheet) {
  for (const world::DronePath& path : paths) {
    std::vector<Vector2d> points;
    for (const Eigen::Vector3d& point : path.points) points.emplace_back(point.head<2>());
    if (points.size() > 1) sheet.line(points, colors::kDrone, 1.5, true);
    draw_start(path.id, path.points.front(), sheet);
  }
}

}  // namespace

drawing::Drawing draw_plan(const Scenario& scenario, int size_px,
                           std::span<const world::DronePath> paths) {
  const LoadedCrowd loaded = load_scenario_crowd(scenario);
  const Routes routes = find_routes(scenario, loaded);
  Sheet sheet(scenario.ground, size_px);
  draw_ground(scenario, sheet);
  draw_props(scenario, sheet);
  draw_obstacles(loaded.crowd.obstacles, sheet);
  name_buildings(scenario, sheet);
  draw_goals(scenario, loaded.crowd.goals, sheet);
  draw_people(loaded, sheet);
  draw_flows(scenario, loaded, routes, sheet);
  draw_exits(scenario, sheet);
  draw_inner_doors(scenario, sheet);
  if (paths.empty()) {
    draw_drones(scenario, sheet);
  } else {
    draw_paths(paths, sheet);
  }
  sheet.finish(scenario.name);
  return sheet.take();
}

}  // namespace throng::scenarios
