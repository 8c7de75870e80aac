#include "places/scenarios/check/survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "base/geometry/polygon.h"
#include "crowd/behavior/load_behavior.h"
#include "crowd/elements/element.h"
#include "crowd/scene.h"
#include "crowd/state/model.h"
#include "world/scenario_crowd.h"

namespace throng::scenarios {

using Eigen::Vector2d;
using Eigen::Vector2f;

namespace {

constexpr double kMarginM = 2;  // of the grid around `inside`
constexpr double kMaxCells = 4e6;
constexpr double kFinestCellM = 0.1;
constexpr double kUsualCellM = 0.2;

float min_radius_m(const LoadedCrowd& loaded) {
  const std::vector<float>& radius = loaded.crowd.agents[crowd::Property::radius];
  float min_radius_m = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < loaded.count(); ++i) {
    if (loaded.is_person[i] != 0) min_radius_m = std::min(min_radius_m, radius[i]);
  }
  constexpr float kWithoutPeopleM = 0.2F;
  return min_radius_m < std::numeric_limits<float>::max() ? min_radius_m : kWithoutPeopleM;
}

std::uint32_t walls_of_people(const LoadedCrowd& loaded) {
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < loaded.count(); ++i) {
    if (loaded.is_person[i] != 0) mask |= loaded.crowd.agents.obstacle_mask[i];
  }
  return mask != 0 ? mask : ~std::uint32_t{0};
}

/// Fine enough for the narrowest door, coarse enough for memory.
float cell_size_m(const world::Scenario& scenario, const world::Rectangle& around,
                  double radius_m) {
  double cell_m = kUsualCellM;
  for (const world::Exit& exit : scenario.exits) {
    cell_m = std::min(cell_m, (exit.width_m() - 2 * radius_m) / 3);
  }
  const Vector2d size = around.max - around.min + Vector2d::Constant(2 * kMarginM);
  return static_cast<float>(
      std::max({cell_m, kFinestCellM, std::sqrt(size.x() * size.y() / kMaxCells)}));
}

/// The cells on a door's line that somebody can stand in.
std::vector<int> cells_of_door(const world::Exit& exit, const Routes& routes) {
  std::vector<int> cells;
  const int samples = 1 + static_cast<int>(2 * exit.length_m() / routes.grid.cell_m);
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    const int cell = routes.cell_at((1 - t) * exit.from + t * exit.to);
    if (cell != Routes::kNone && routes.grid.walkable[static_cast<std::size_t>(cell)] != 0) {
      cells.push_back(cell);
    }
  }
  return cells;
}

/// For each cell of a door: whether somebody in it gets 1 m away from the door on one side,
/// straight or around obstacles.
std::vector<std::uint8_t> gets_away(const std::vector<int>& door, const world::Exit& exit,
                                    const Vector2d& towards, const Routes& routes) {
  constexpr double kAwayM = 1;
  const crowd::WalkableGrid& grid = routes.grid;
  std::vector<std::uint8_t> result;
  for (const int start : door) {
    std::set<int> seen{start};
    std::vector<int> open{start};
    bool is_away = false;
    while (!open.empty() && !is_away) {
      const Vector2d at = routes.cell_center(open.back());
      open.pop_back();
      for (const auto& [x, y] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const Vector2d next = at + grid.cell_m * Vector2d(x, y);
        if ((next - exit.from).dot(towards) < -grid.cell_m) continue;  // on the other side
        const int cell = routes.cell_at(next);
        is_away = is_away || cell == Routes::kNone ||
                  (grid.walkable[static_cast<std::size_t>(cell)] != 0 &&
                   geometry::distance_to_segment(exit.from, exit.to, next) >= kAwayM);
        if (cell == Routes::kNone || grid.walkable[static_cast<std::size_t>(cell)] == 0) continue;
        if (seen.insert(cell).second) open.push_back(cell);
      }
    }
    result.push_back(is_away ? 1 : 0);
  }
  return result;
}

using Open = std::pair<float, int>;  // m, cell
using Frontier = std::priority_queue<Open, std::vector<Open>, std::greater<>>;

void look_around(const Open& from, Routes& routes, Frontier& open) {
  const crowd::WalkableGrid& grid = routes.grid;
  const int column = from.second % grid.columns;
  const int row = from.second / grid.columns;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int x = column + dx;
      const int y = row + dy;
      if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= grid.columns || y >= grid.rows) continue;
      const std::size_t next = grid.index(x, y);
      // Nobody slips through between two cells that touch at a corner only.
      if (grid.walkable[next] == 0 || grid.walkable[grid.index(x, row)] == 0 ||
          grid.walkable[grid.index(column, y)] == 0) {
        continue;
      }
      constexpr float kDiagonal = 1.41421356F;
      const float distance = from.first + grid.cell_m * (dx != 0 && dy != 0 ? kDiagonal : 1.0F);
      if (distance >= routes.distance_m[next]) continue;
      routes.distance_m[next] = distance;
      routes.nearest_exit[next] = routes.nearest_exit[static_cast<std::size_t>(from.second)];
      open.push({distance, static_cast<int>(next)});
    }
  }
}

/// Dijkstra (1959) from all open doors at once.
void walk_from_doors(const world::Scenario& scenario, Routes& routes) {
  Frontier open;
  for (std::size_t i = 0; i < scenario.exits.size(); ++i) {
    const world::Exit& exit = scenario.exits[i];
    if (!exit.open || !is_passable(exit, routes)) continue;
    for (const int cell : cells_of_door(exit, routes)) {
      routes.reached_from_exit[i] = 1;
      routes.distance_m[static_cast<std::size_t>(cell)] = 0;
      routes.nearest_exit[static_cast<std::size_t>(cell)] = static_cast<int>(i);
      open.push({0.0F, cell});
    }
  }
  while (!open.empty()) {
    const Open next = open.top();
    open.pop();
    if (next.first <= routes.distance_m[static_cast<std::size_t>(next.second)]) {
      look_around(next, routes, open);
    }
  }
}

/// The groups of a blueprint's crowd, whose comments are JSON pointers (crowd_scene.cpp).
std::vector<std::pair<std::size_t, std::string>> list_parts(
    const crowd::Node& scene, const std::vector<std::size_t>& first_agents) {
  std::vector<std::pair<std::size_t, std::string>> parts;
  for (const crowd::Node& node : scene.children) {
    if (node.name == "AgentGroup") parts.emplace_back(first_agents[parts.size()], node.comment);
  }
  return parts;
}

}  // namespace

std::string LoadedCrowd::part_of(std::size_t agent) const {
  std::string part = "/crowd/scene";
  for (const auto& [first, pointer] : parts) {
    if (first <= agent) part = pointer;
  }
  return part;
}

LoadedCrowd load_scenario_crowd(const world::Scenario& scenario) {
  LoadedCrowd loaded;
  const crowd::CrowdDescription description = world::build_crowd(scenario);
  crowd::Reading scene(description.scene, "Experiment");
  crowd::Reading behavior(description.behavior, "BFSM");
  const crowd::ModelEntry& model =
      crowd::find_model(scenario.crowd_model.empty() ? "ttc" : scenario.crowd_model);
  const std::vector<std::string> states = crowd::load_state_names(behavior.root());
  crowd::MengeSequences sequences(crowd::Compat::none, loaded.crowd.seed);
  const crowd::Scene parts =
      crowd::load_scene(scene.root(), states, model, sequences, loaded.crowd);
  crowd::load_behavior(behavior.root(), states, parts.profile_modifiers, sequences, loaded.crowd);
  if (scenario.built_crowd) {
    loaded.parts = list_parts(description.scene.root, parts.first_agents);
  } else {
    loaded.warnings = scene.warnings();
    loaded.warnings.insert(loaded.warnings.end(), behavior.warnings().begin(),
                           behavior.warnings().end());
  }
  loaded.is_person.assign(loaded.crowd.agents.count(), 1);
  for (const int agent : scenario.disaster_agents) {
    if (static_cast<std::size_t>(agent) < loaded.count()) {
      loaded.is_person[static_cast<std::size_t>(agent)] = 0;
    }
  }
  return loaded;
}

int Routes::cell_at(const Vector2d& point) const {
  const Vector2f at = (point.cast<float>() - grid.box.min) / grid.cell_m;
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < static_cast<float>(grid.columns) &&
        at.y() < static_cast<float>(grid.rows))) {
    return kNone;
  }
  return static_cast<int>(at.y()) * grid.columns + static_cast<int>(at.x());
}

int Routes::walkable_near(const Vector2d& point, double reach_m) const {
  const int steps = static_cast<int>(std::ceil(reach_m / grid.cell_m));
  int best = kNone;
  double best_m = reach_m;
  for (int y = -steps; y <= steps; ++y) {
    for (int x = -steps; x <= steps; ++x) {
      const Vector2d at = point + grid.cell_m * Vector2d(x, y);
      const int cell = cell_at(at);
      if (cell == kNone || grid.walkable[static_cast<std::size_t>(cell)] == 0) continue;
      const double distance = (at - point).norm();
      if (distance > best_m || (best != kNone && distance == best_m)) continue;
      best = cell;
      best_m = distance;
    }
  }
  return best;
}

Vector2d Routes::cell_center(int cell) const {
  return grid.center(cell % grid.columns, cell / grid.columns).cast<double>();
}

crowd::WalkableGrid walkable_ground(const world::Scenario& scenario, const LoadedCrowd& loaded,
                                    const world::Rectangle& around) {
  const float radius_m = min_radius_m(loaded);
  const Vector2d margin = Vector2d::Constant(kMarginM);
  const crowd::Box box{(around.min - margin).cast<float>(), (around.max + margin).cast<float>()};
  return crowd::mark_walkable(loaded.crowd.obstacles, walls_of_people(loaded), box,
                              cell_size_m(scenario, around, radius_m), radius_m);
}

world::Rectangle bounds_with_exits(const world::Scenario& scenario) {
  world::Rectangle around = scenario.inside.bounds;
  for (const world::Exit& exit : scenario.exits) {
    around.extend(exit.from);
    around.extend(exit.to);
  }
  return around;
}

bool is_passable(const world::Exit& exit, const Routes& routes) {
  const std::vector<int> door = cells_of_door(exit, routes);
  const std::vector<std::uint8_t> in = gets_away(door, exit, -exit.outward, routes);
  const std::vector<std::uint8_t> out = gets_away(door, exit, exit.outward, routes);
  for (std::size_t i = 0; i < door.size(); ++i) {
    if (in[i] != 0 && out[i] != 0) return true;
  }
  return false;
}

Routes find_routes(const world::Scenario& scenario, const LoadedCrowd& loaded) {
  Routes routes;
  routes.grid = walkable_ground(scenario, loaded, bounds_with_exits(scenario));
  routes.nearest_exit.assign(routes.grid.walkable.size(), Routes::kNone);
  routes.distance_m.assign(routes.grid.walkable.size(), std::numeric_limits<float>::infinity());
  routes.reached_from_exit.assign(scenario.exits.size(), 0);
  walk_from_doors(scenario, routes);
  return routes;
}

}  // namespace throng::scenarios
