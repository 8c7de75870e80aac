// The parts of scenarios::check() that concern exits.
#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/geometry/polygon.h"
#include "places/scenarios/check/check_scenario.h"
#include "places/scenarios/check/exit_sides.h"
#include "places/scenarios/check/sufferers.h"

namespace throng::scenarios {

using world::Exit;
using world::Scenario;

namespace {

/// Whether somebody could head for an exit: one of its goals is in a set that a state chooses from.
bool has_demand(const Exit& exit, const crowd::Goals& goals) {
  return std::any_of(exit.goals.begin(), exit.goals.end(), [&](const world::GoalRef& goal) {
    const int set = goals.find_set(goal.set);
    return set >= 0 && goals.is_used(set) && goals.find_goal(goal.set, goal.goal) >= 0;
  });
}

void check_goals(const Exit& exit, const std::string& where, const crowd::Goals& goals,
                 Findings& findings) {
  for (std::size_t i = 0; i < exit.goals.size(); ++i) {
    const world::GoalRef& goal = exit.goals[i];
    if (goals.find_goal(goal.set, goal.goal) >= 0) continue;
    findings.error(
        fmt::format("{}/goals/{}", where, i),
        fmt::format("[{}, {}], which the behavior file does not have", goal.set, goal.goal),
        "a goal set and goal of the behavior file",
        "add the <Goal> to the behavior file, or correct the numbers");
  }
}

bool anybody_reaches(std::size_t exit, const LoadedCrowd& loaded, const Routes& routes) {
  if (routes.reached_from_exit[exit] == 0) return false;
  // Somebody reaches this exit where any exit is reached and both are connected: from the door
  // inwards, the ground has a way on to somebody.
  std::vector<std::uint8_t> seen(routes.grid.walkable.size(), 0);
  std::vector<int> open;
  for (std::size_t cell = 0; cell < seen.size(); ++cell) {
    if (routes.nearest_exit[cell] == static_cast<int>(exit) && routes.distance_m[cell] == 0) {
      open.push_back(static_cast<int>(cell));
      seen[cell] = 1;
    }
  }
  while (!open.empty()) {
    const int cell = open.back();
    open.pop_back();
    const int column = cell % routes.grid.columns;
    const int row = cell / routes.grid.columns;
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const int x = column + dx;
      const int y = row + dy;
      if (x < 0 || y < 0 || x >= routes.grid.columns || y >= routes.grid.rows) continue;
      const std::size_t next = routes.grid.index(x, y);
      if (seen[next] != 0 || routes.grid.walkable[next] == 0) continue;
      seen[next] = 1;
      open.push_back(static_cast<int>(next));
    }
  }
  for (std::size_t agent = 0; agent < loaded.count(); ++agent) {
    if (!is_to_arrive_or_there(loaded, agent)) continue;
    const int cell = routes.cell_at(loaded.start(agent));
    if (cell == Routes::kNone || seen[static_cast<std::size_t>(cell)] != 0) return true;
  }
  return false;
}

/// An exit of which nobody, or hardly anybody, could make use.
void check_use(std::size_t index, const Scenario& scenario, const LoadedCrowd& loaded,
               const Routes& routes, const ExitSides& sides, Findings& findings) {
  constexpr double kMinWidthM = 0.5;
  const Exit& exit = scenario.exits[index];
  const std::string where = fmt::format("/exits/{}", index);
  if (exit.width_m() < kMinWidthM) {
    findings.error(where, fmt::format("exit \"{}\" {:.2g} m wide", exit.id, exit.width_m()),
                   fmt::format("at least {} m", kMinWidthM),
                   "widen it, or give its ends in meters");
  } else if (!is_passable(exit, routes)) {
    findings.error(where, fmt::format("exit \"{}\" blocked by obstacles", exit.id), "a way through",
                   findings.either("move the building or prop, or the exit, or say \"open\": false",
                                   "open the obstacle, move the exit or say \"open\": false"));
  } else if (!anybody_reaches(index, loaded, routes)) {
    findings.error(where, fmt::format("exit \"{}\", which nobody can reach", exit.id),
                   "an exit with a way to it", "open a way through the obstacles to it");
  } else if (sides.is_dead_end) {
    findings.error(where,
                   fmt::format("exit \"{}\", behind which walls enclose the ground: people count "
                               "as escaped, but cannot get away",
                               exit.id),
                   "an exit to open ground, or to ground with another exit",
                   "open the walls behind it, add an exit there, or take this one away");
  }
}

/// The line of an exit, on which all figures about it depend.
void check_line(const Exit& exit, const std::string& where, const Scenario& scenario,
                const ExitSides& sides, Findings& findings) {
  constexpr double kSlackM = 0.5;  // a wall's thickness
  const double outside_m = geometry::distance_to(scenario.inside.corners(), exit.middle());
  if (outside_m > kSlackM) {
    findings.warning(where,
                     fmt::format("exit \"{}\" {:.1f} m outside of \"inside\"", exit.id, outside_m),
                     "\"inside\" up to the line of each exit",
                     "enlarge \"inside\", or move the exit to its border");
  }
  constexpr double kWorthNamingM = 0.1;  // less are ends that touch the walls
  const double drawn_m = exit.drawn_m.value_or(exit.length_m());
  if (drawn_m - exit.width_m() > kWorthNamingM) {
    findings.warning(
        where,
        fmt::format("exit \"{}\" {:.3g} m wide, of which buildings leave {:.3g} m free: figures "
                    "count {:.3g} m",
                    exit.id, drawn_m, exit.width_m(), exit.width_m()),
        "an exit as wide as its opening", "draw it from wall to wall, or move the buildings");
  }
  if (sides.has_way_around) {
    findings.warning(where, fmt::format("exit \"{}\", around which people can walk", exit.id),
                     "an exit in an opening of the walls",
                     "move it into an opening, close the way around it, or take it away");
  }
}

}  // namespace

void check_exits(const Scenario& scenario, const LoadedCrowd& loaded, const Routes& routes,
                 bool is_closed, Findings& findings) {
  bool any_demand = false;
  bool any_open = false;
  std::vector<ExitSides> sides = survey_exit_sides(scenario, loaded);
  for (std::size_t i = 0; i < scenario.exits.size(); ++i) {
    const Exit& exit = scenario.exits[i];
    const std::string where = fmt::format("/exits/{}", i);
    if (!exit.open) continue;
    any_open = true;
    // check_outline() says how people get around exits by gaps in the outline.
    sides[i].has_way_around = sides[i].has_way_around && is_closed;
    check_goals(exit, where, loaded.crowd.goals, findings);
    check_use(i, scenario, loaded, routes, sides[i], findings);
    check_line(exit, where, scenario, sides[i], findings);
    if (has_demand(exit, loaded.crowd.goals)) {
      any_demand = true;
    } else {
      findings.warning(
          where,
          fmt::format("exit \"{}\", which {} heads for", exit.id,
                      findings.either("nobody", "no state")),
          findings.either("people who cross, leave or flee, or a source \"towards\" it",
                          "a <GoalSelector> with the goal set of one of its goals"),
          findings.either("let somebody \"cross\" or \"leave\", or take the exit away",
                          "choose among the exits' goals somewhere, or take the exit away"));
    }
  }
  if (!any_open) {
    findings.error("/exits", "no open exit, so that nobody can leave", "at least one",
                   "add an exit, or open one");
  } else if (!any_demand) {
    findings.error(
        "/exits", "no exit that anybody heads for", "at least one",
        findings.either(
            "let somebody \"cross\" or \"leave\", or add a disaster from which they flee",
            "let a state of the behavior file choose among the exits' goals"));
  }
}

}  // namespace throng::scenarios
