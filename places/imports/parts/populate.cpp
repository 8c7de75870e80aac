#include "places/imports/parts/populate.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/compute/random.h"
#include "base/error.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "places/imports/parts/free_ground.h"

namespace throng::imports {

using Eigen::Vector2d;

namespace {

constexpr double kNarrowestGateM = 1.2;
constexpr double kMaxFoundGateM = 8;
constexpr std::size_t kMaxFoundGates = 12;
constexpr double kBeforeGateM = 1.5;  // where a gate's ground must be free, on both sides
constexpr double kApartM = 0.9;
constexpr double kFromEdgeM = 2;
constexpr double kCellM2 = FreeGround::kCellM * FreeGround::kCellM;

// The region that a gate leads into, if it is free from before it to behind it. A wall on the line
// itself may have the same region on both sides.
int find_region(const Gate& gate, const world::Rectangle& inside, const FreeGround& ground) {
  const Vector2d middle = 0.5 * (gate.from + gate.to);
  const Vector2d out = outward_direction(gate, inside);
  const int region = ground.region_at(middle - kBeforeGateM * out);
  constexpr double kStepM = 0.5 * FreeGround::kCellM;
  for (double at = -kBeforeGateM; at <= kBeforeGateM; at += kStepM) {
    if (ground.region_at(middle + at * out) != region) return FreeGround::kBlocked;
  }
  return region;
}

// Open stretches of one side of the rectangle, as gates no wider than people need.
void find_gates_along(const Vector2d& from, const Vector2d& to, const world::Rectangle& inside,
                      const FreeGround& ground, std::vector<Gate>& gates) {
  const Vector2d along = (to - from).normalized();
  const double length = (to - from).norm();
  double open_from = 0;
  for (double at = 0;; at += FreeGround::kCellM) {
    const Vector2d point = from + at * along;
    const Gate probe{point - 0.5 * along, point + 0.5 * along};
    const bool open = at < length && find_region(probe, inside, ground) != FreeGround::kBlocked;
    if (open) continue;
    const double width = at - FreeGround::kCellM - open_from;
    if (width >= kNarrowestGateM) {
      const Vector2d middle = from + 0.5 * (open_from + at - FreeGround::kCellM) * along;
      const double half = 0.5 * std::min(width, kMaxFoundGateM);
      gates.push_back({middle - half * along, middle + half * along, 2 * half});
    }
    open_from = at + FreeGround::kCellM;
    if (at >= length) break;
  }
}

std::vector<Gate> find_gates(const world::Rectangle& inside, const FreeGround& ground) {
  const Corners corners = rectangle_corners(inside);
  std::vector<Gate> gates;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    find_gates_along(corners[i], corners[(i + 1) % corners.size()], inside, ground, gates);
  }
  std::stable_sort(gates.begin(), gates.end(), [](const Gate& a, const Gate& b) {
    return (a.to - a.from).norm() > (b.to - b.from).norm();
  });
  if (gates.size() > kMaxFoundGates) gates.resize(kMaxFoundGates);
  return gates;
}

std::string describe_gate(const Gate& gate) {
  return fmt::format("exit from [{:.1f}, {:.1f}] to [{:.1f}, {:.1f}]", gate.from.x(), gate.from.y(),
                     gate.to.x(), gate.to.y());
}

// The largest of all regions with a gate.
int main_region(const std::vector<Gate>& gates, const world::Rectangle& inside,
                const FreeGround& ground) {
  int best = FreeGround::kBlocked;
  for (const Gate& gate : gates) {
    const int region = find_region(gate, inside, ground);
    if (region == FreeGround::kBlocked) continue;
    if (best == FreeGround::kBlocked || ground.size_of(region) > ground.size_of(best)) {
      best = region;
    }
  }
  return best;
}

bool is_in_the_way(const world::Prop& prop, const ImportedScenario& scenario,
                   const std::vector<geometry::Rectangle>& bounds, const std::vector<Gate>& gates) {
  constexpr double kSlackM = 0.1;
  const geometry::Rectangle around{prop.position - Vector2d::Constant(kSlackM),
                                   prop.position + Vector2d::Constant(kSlackM)};
  for (std::size_t i = 0; i < scenario.buildings.size(); ++i) {
    if (!around.meets(bounds[i])) continue;
    if (geometry::distance_to(scenario.buildings[i].footprint, prop.position) < kSlackM)
      return true;
  }
  const double clear_m = world::kClearOfExitsM + kSlackM + prop.scale;
  for (const Gate& gate : gates) {
    const Vector2d along = (gate.to - gate.from).normalized();
    const Vector2d out = outward_direction(gate, scenario.inside);
    const Vector2d off = prop.position - 0.5 * (gate.from + gate.to);
    const double half = 0.5 * (gate.to - gate.from).norm() + prop.scale + kSlackM;
    if (std::abs(off.dot(along)) < half && std::abs(off.dot(out)) < clear_m) return true;
  }
  return false;
}

void take_props_away(ImportedScenario& scenario, const std::vector<Gate>& gates) {
  std::vector<geometry::Rectangle> bounds;
  for (const world::Building& building : scenario.buildings) {
    bounds.push_back(geometry::bounding_box(building.footprint));
  }
  std::erase_if(scenario.props, [&](const world::Prop& prop) {
    if (!is_in_the_way(prop, scenario, bounds, gates)) return false;
    scenario.skipped.push_back(
        {"", 0,
         fmt::format("{} at [{:.1f}, {:.1f}]", world::prop_type(prop.kind).name, prop.position.x(),
                     prop.position.y()),
         "stands in a building or before an exit"});
    return true;
  });
}

std::vector<Corners> obstacles_with_props(const ImportedScenario& scenario) {
  std::vector<Corners> obstacles = scenario.obstacles;
  for (const world::Prop& prop : scenario.props) {
    const auto corners = world::prop_footprint(prop);
    obstacles.emplace_back(corners.begin(), corners.end());
  }
  return obstacles;
}

// Yards and rooms that nobody can leave are part of what the file has.
void note_enclosed(ImportedScenario& scenario, const FreeGround& ground, int main) {
  constexpr double kWorthSayingM2 = 20;
  double enclosed_m2 = 0;
  for (int region = 0; region < ground.regions(); ++region) {
    const double size = static_cast<double>(ground.size_of(region)) * kCellM2;
    if (region != main && size >= kWorthSayingM2) enclosed_m2 += size;
  }
  if (enclosed_m2 == 0) return;
  scenario.skipped.push_back(
      {"", 0, "ground",
       fmt::format("nobody is on {:.0f} m² that no exit can be reached from", enclosed_m2)});
}

// Cells in an order that the seed draws; one is taken where nobody taken before is near.
std::vector<Vector2d> draw_starts(std::vector<Vector2d> cells, const std::vector<Vector2d>& first,
                                  const PopulateOptions& options) {
  Random random(options.seed, Stream::crowd_generator);
  std::map<std::pair<int, int>, std::vector<Vector2d>> taken;
  const auto bin = [](const Vector2d& p) {
    return std::pair(static_cast<int>(std::floor(p.x() / kApartM)),
                     static_cast<int>(std::floor(p.y() / kApartM)));
  };
  const auto is_free = [&](const Vector2d& point) {
    const auto [column, row] = bin(point);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const auto near = taken.find({column + dx, row + dy});
        if (near == taken.end()) continue;
        for (const Vector2d& other : near->second) {
          if ((other - point).norm() < kApartM) return false;
        }
      }
    }
    return true;
  };
  std::vector<Vector2d> starts;
  const auto take = [&](const Vector2d& point) {
    if (!is_free(point)) return;
    starts.push_back(point);
    taken[bin(point)].push_back(point);
  };
  for (const Vector2d& point : first) take(point);
  for (std::size_t left = cells.size();
       left > 0 && starts.size() < static_cast<std::size_t>(options.people); --left) {
    const std::size_t pick = random.below(static_cast<std::uint32_t>(left));
    std::swap(cells[pick], cells[left - 1]);
    take(cells[left - 1]);
  }
  return starts;
}

}  // namespace

world::Rectangle ground_rectangle(const ImportedScenario& scenario) {
  const Vector2d beyond = Vector2d::Constant(kGroundBeyondM);
  return {scenario.inside.min - beyond, scenario.inside.max + beyond};
}

Vector2d outward_direction(const Gate& gate, const world::Rectangle& inside) {
  const Vector2d along = (gate.to - gate.from).normalized();
  const Vector2d normal(along.y(), -along.x());
  const Vector2d from_middle = 0.5 * (gate.from + gate.to) - 0.5 * (inside.min + inside.max);
  return normal.dot(from_middle) >= 0 ? normal : Vector2d(-normal);
}

double open_ground_m2(const ImportedScenario& scenario) {
  const FreeGround ground(ground_rectangle(scenario), obstacles_with_props(scenario));
  int region = main_region(scenario.gates, scenario.inside, ground);
  if (region == FreeGround::kBlocked && !scenario.gates_asked) {
    region = main_region(find_gates(scenario.inside, ground), scenario.inside, ground);
  }
  if (region == FreeGround::kBlocked) return 0;
  const std::vector<Vector2d> cells = ground.cells_in_region(region);
  const auto inside = std::count_if(cells.begin(), cells.end(), [&](const Vector2d& cell) {
    return scenario.inside.contains(cell);
  });
  return static_cast<double>(inside) * kCellM2;
}

Population populate(ImportedScenario& scenario, const PopulateOptions& options) {
  const world::Rectangle ground_area = ground_rectangle(scenario);
  const FreeGround ground(ground_area, obstacles_with_props(scenario));
  std::vector<Gate> candidates = scenario.gates;
  int region = main_region(candidates, scenario.inside, ground);
  if (region == FreeGround::kBlocked && !scenario.gates_asked) {
    if (!candidates.empty()) {
      scenario.skipped.push_back(
          {"", 0, "exits", "all ways out are walled up: open ground instead"});
    }
    candidates = find_gates(scenario.inside, ground);
    region = main_region(candidates, scenario.inside, ground);
  }
  if (region == FreeGround::kBlocked) {
    throw InputError({scenario.name, "",
                      scenario.gates_asked ? "exits that are walled up" : "no open edge",
                      "a scenario with at least one way out, or an exit on free ground (--exit)"});
  }
  Population population;
  for (const Gate& gate : candidates) {
    if (find_region(gate, scenario.inside, ground) == region) {
      population.gates.push_back(gate);
    } else {
      scenario.skipped.push_back(
          {"", 0, describe_gate(gate), "cannot be reached from the other exits"});
    }
  }
  note_enclosed(scenario, ground, region);
  take_props_away(scenario, population.gates);
  std::vector<Vector2d> cells = ground.cells_in_region(region);
  const Vector2d edge = Vector2d::Constant(kFromEdgeM);
  const world::Rectangle middle{scenario.inside.min + edge, scenario.inside.max - edge};
  std::erase_if(cells, [&](const Vector2d& cell) { return !middle.contains(cell); });
  std::vector<Vector2d> first;
  for (const Vector2d& person : scenario.people) {
    if (first.size() < static_cast<std::size_t>(options.people) && middle.contains(person) &&
        ground.region_at(person) == region) {
      first.push_back(person);
    } else {
      scenario.skipped.push_back({"", 0,
                                  fmt::format("person at [{:.1f}, {:.1f}]", person.x(), person.y()),
                                  "stands where nobody can, or is one more than --people"});
    }
  }
  population.starts = draw_starts(std::move(cells), first, options);
  if (population.starts.size() < static_cast<std::size_t>(options.people)) {
    scenario.skipped.push_back(
        {"", 0, "people",
         fmt::format("there is room for {} of {}", population.starts.size(), options.people)});
  }
  return population;
}

}  // namespace throng::imports
