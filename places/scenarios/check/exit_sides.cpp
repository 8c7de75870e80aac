#include "places/scenarios/check/exit_sides.h"

#include <algorithm>
#include <set>

#include "places/scenarios/check/closed_ground.h"

namespace throng::scenarios {

using Eigen::Vector2d;

namespace {

constexpr int kOpenGround = 0;  // in ClosedGround::parts()

/// The bounding box of all that can enclose ground behind an exit.
world::Rectangle around_walls(const world::Scenario& scenario, const LoadedCrowd& loaded) {
  constexpr double kReachM = 100;  // farther walls would make the grid's cells too large
  const world::Rectangle core = bounds_with_exits(scenario);
  const Vector2d reach = Vector2d::Constant(kReachM);
  world::Rectangle around = core;
  for (const crowd::Segment& wall : loaded.crowd.obstacles.segments()) {
    for (const Vector2d& end :
         {Vector2d(wall.begin.cast<double>()), Vector2d(wall.end.cast<double>())}) {
      around.extend(end.cwiseMax(core.min - reach).cwiseMin(core.max + reach));
    }
  }
  return around;
}

/// The parts of the ground before and behind an exit.
struct Passage {
  std::set<int> inner;
  std::set<int> outer;
};

std::vector<Passage> find_passages(const world::Scenario& scenario, const LoadedCrowd& loaded) {
  Routes wide;  // only the grid of it
  wide.grid = walkable_ground(scenario, loaded, around_walls(scenario, loaded));
  const ClosedGround ground(scenario, loaded, wide);
  const std::vector<int> parts = ground.parts();
  const auto parts_beside = [&](const world::Exit& exit, const Vector2d& towards) {
    std::set<int> found;
    for (const int cell : ground.beside(exit, towards)) {
      found.insert(parts[static_cast<std::size_t>(cell)]);
    }
    return found;
  };
  std::vector<Passage> passages;
  for (const world::Exit& exit : scenario.exits) {
    Passage& passage = passages.emplace_back();
    if (!exit.open) continue;
    passage.inner = parts_beside(exit, -exit.outward);
    passage.outer = parts_beside(exit, exit.outward);
  }
  return passages;
}

bool have_common(const std::set<int>& a, const std::set<int>& b) {
  return std::any_of(a.begin(), a.end(), [&](int part) { return b.contains(part); });
}

/// The parts from which open ground is reached through exits in their direction.
std::set<int> parts_with_way_out(const std::vector<Passage>& passages) {
  std::set<int> found = {kOpenGround};
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (const Passage& passage : passages) {
      if (have_common(passage.outer, found))
        found.insert(passage.inner.begin(), passage.inner.end());
    }
  }
  return found;
}

}  // namespace

std::vector<ExitSides> survey_exit_sides(const world::Scenario& scenario,
                                         const LoadedCrowd& loaded) {
  const std::vector<Passage> passages = find_passages(scenario, loaded);
  const std::set<int> with_way_out = parts_with_way_out(passages);
  std::vector<ExitSides> sides;
  for (const Passage& passage : passages) {
    ExitSides& of_exit = sides.emplace_back();
    if (passage.inner.empty() || passage.outer.empty()) continue;
    of_exit.is_dead_end = !have_common(passage.outer, with_way_out);
    of_exit.has_way_around =
        have_common(passage.inner, passage.outer) && !passage.inner.contains(kOpenGround);
  }
  return sides;
}

}  // namespace throng::scenarios
