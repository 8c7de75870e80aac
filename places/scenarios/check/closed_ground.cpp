#include "places/scenarios/check/closed_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/geometry/polygon.h"

namespace throng::scenarios {

using Eigen::Vector2d;

namespace {

float mean_radius_m(const LoadedCrowd& loaded) {
  const std::vector<float>& radius = loaded.crowd.agents[crowd::Property::radius];
  double sum = 0;
  std::size_t people = 0;
  for (std::size_t i = 0; i < loaded.count(); ++i) {
    if (loaded.is_person[i] == 0) continue;
    sum += radius[i];
    ++people;
  }
  return people > 0 ? static_cast<float>(sum / static_cast<double>(people)) : 0;
}

}  // namespace

ClosedGround::ClosedGround(const world::Scenario& scenario, const LoadedCrowd& loaded,
                           const Routes& routes)
    : routes_(routes), free_(routes.grid.walkable) {
  const double reach_m = mean_radius_m(loaded);  // crossings count so far beside a door
  for (const world::Exit& exit : scenario.exits) {
    if (!exit.open) continue;
    const Vector2d beside = reach_m * (exit.to - exit.from).normalized();
    draw(exit.from - beside, exit.to + beside);
    doors_.emplace_back(exit.from, exit.to);
  }
  for (const world::Exit& exit : scenario.exits) {
    if (!exit.open) continue;
    for (const int cell : beside(exit, -exit.outward)) inner_.push_back(cell);
    for (const int cell : beside(exit, exit.outward)) outer_.push_back(cell);
  }
  closed_ = free_;
}

void ClosedGround::add_people(const LoadedCrowd& loaded) {
  Cells side(free_.size(), 0);
  std::vector<int> queue = inner_;
  for (const int cell : inner_) side[static_cast<std::size_t>(cell)] = 1;
  for (const int cell : outer_) {
    std::uint8_t& of_cell = side[static_cast<std::size_t>(cell)];
    if (of_cell != 0) continue;
    of_cell = 2;
    queue.push_back(cell);
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const int other : neighbors(queue[next])) {
      if (!is_free(other) || side[static_cast<std::size_t>(other)] != 0) continue;
      side[static_cast<std::size_t>(other)] = side[static_cast<std::size_t>(queue[next])];
      queue.push_back(other);
    }
  }
  for (std::size_t agent = 0; agent < loaded.count(); ++agent) {
    if (loaded.is_person[agent] == 0 || !loaded.start(agent).allFinite()) continue;
    const int cell = routes_.cell_at(loaded.start(agent));
    if (cell != Routes::kNone && side[static_cast<std::size_t>(cell)] == 1) {
      people_.push_back(cell);
    }
  }
}

void ClosedGround::draw(const Vector2d& from, const Vector2d& to) {
  const double step_m = 0.25 * cell_m();
  const int steps = 1 + static_cast<int>((to - from).norm() / step_m);
  for (int i = 0; i <= steps; ++i) {
    const Vector2d at = from + static_cast<double>(i) / steps * (to - from);
    for (const auto& [x, y] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}, {0, 0}}) {
      const int cell = routes_.cell_at(at + 0.5 * cell_m() * Vector2d(x, y));
      if (cell != Routes::kNone) free_[static_cast<std::size_t>(cell)] = 0;
    }
  }
}

std::vector<int> ClosedGround::way_out() const {
  std::vector<int> before(free_.size(), kUnseen);
  std::vector<int> queue = inner_;
  for (const int cell : queue) before[static_cast<std::size_t>(cell)] = cell;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int cell = queue[next];
    if (is_on_border(cell)) return traced(cell, before);
    for (const int other : neighbors(cell)) {
      if (!is_free(other) || before[static_cast<std::size_t>(other)] != kUnseen) continue;
      before[static_cast<std::size_t>(other)] = cell;
      queue.push_back(other);
    }
  }
  return {};
}

Cells ClosedGround::reached_from(int start) const {
  Cells seen(free_.size(), 0);
  std::vector<int> open{start};
  seen[static_cast<std::size_t>(start)] = 1;
  while (!open.empty()) {
    const int cell = open.back();
    open.pop_back();
    for (const int other : neighbors(cell)) {
      if (!is_free(other) || seen[static_cast<std::size_t>(other)] != 0) continue;
      seen[static_cast<std::size_t>(other)] = 1;
      open.push_back(other);
    }
  }
  return seen;
}

void ClosedGround::close(const std::vector<Chord>& lines) {
  free_ = closed_;
  for (const Chord& line : lines) draw(line.from, line.to);
}

bool ClosedGround::may_close(const Chord& line, const Cells& reached) {
  const Cells before = free_;
  draw(line.from, line.to);
  const bool may = is_free(line.inner) && keeps_all(reached_from(line.inner), reached);
  free_ = before;
  return may;
}

std::optional<Chord> ClosedGround::shortest_chord(int cell) const {
  constexpr int kDirections = 24;
  std::optional<Chord> best;
  const Vector2d at = routes_.cell_center(cell);
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = std::numbers::pi * i / kDirections;
    const Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    const double enough_m = best ? best->length_m() : std::numeric_limits<double>::infinity();
    const auto one = wall_from(at, along, enough_m);
    if (!one) continue;
    const auto other = wall_from(at, -along, enough_m - (*one - at).norm());
    if (other) best = Chord{.from = *one, .to = *other};
  }
  return best;
}

bool ClosedGround::leads_through(const std::vector<int>& way, const Chord& line) const {
  const Vector2d along = line.to - line.from;
  const auto beside = [&](int cell) {
    return geometry::cross(along, routes_.cell_center(cell) - line.from);
  };
  bool through = false;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double a = beside(way[i]);
    const double b = beside(way[i + 1]);
    if ((a >= 0) == (b >= 0)) continue;
    const Vector2d from = routes_.cell_center(way[i]);
    const Vector2d at = from + a / (a - b) * (routes_.cell_center(way[i + 1]) - from);
    const double share = (at - line.from).dot(along) / along.squaredNorm();
    if (share >= 0 && share <= 1) through = !through;
  }
  return through;
}

std::size_t ClosedGround::first_on(const Chord& line, const std::vector<int>& way) const {
  const auto found = std::find_if(way.begin(), way.end(), [&](int cell) {
    return geometry::distance_to_segment(line.from, line.to, routes_.cell_center(cell)) <= cell_m();
  });
  return static_cast<std::size_t>(found - way.begin());
}

std::vector<int> ClosedGround::beside(const world::Exit& exit, const Vector2d& towards) const {
  constexpr double kDepthM = 1;
  std::vector<int> cells;
  const int across = 1 + static_cast<int>(exit.length_m() / cell_m());
  for (int i = 0; i <= across; ++i) {
    const Vector2d at = exit.from + static_cast<double>(i) / across * (exit.to - exit.from);
    for (double s = 1.5 * cell_m(); s <= kDepthM; s += 0.5 * cell_m()) {
      const int cell = routes_.cell_at(at + s * towards);
      if (!is_free(cell)) continue;
      cells.push_back(cell);
      break;
    }
  }
  return cells;
}

std::vector<int> ClosedGround::parts() const {
  std::vector<int> parts(free_.size(), Routes::kNone);
  std::vector<int> open;
  int count = 1;  // part 0 has the border
  const auto add = [&](int cell, int part) {
    if (!is_free(cell) || parts[static_cast<std::size_t>(cell)] != Routes::kNone) return false;
    open.push_back(cell);
    parts[static_cast<std::size_t>(cell)] = part;
    while (!open.empty()) {
      const int from = open.back();
      open.pop_back();
      for (const int other : neighbors(from)) {
        if (!is_free(other) || parts[static_cast<std::size_t>(other)] != Routes::kNone) continue;
        parts[static_cast<std::size_t>(other)] = part;
        open.push_back(other);
      }
    }
    return true;
  };
  const auto cells = static_cast<int>(free_.size());
  for (int cell = 0; cell < cells; ++cell) {
    if (is_on_border(cell)) add(cell, 0);
  }
  for (int cell = 0; cell < cells; ++cell) {
    if (add(cell, count)) ++count;
  }
  return parts;
}

bool ClosedGround::is_on_border(int cell) const {
  const int column = cell % routes_.grid.columns;
  const int row = cell / routes_.grid.columns;
  return column == 0 || row == 0 || column == routes_.grid.columns - 1 ||
         row == routes_.grid.rows - 1;
}

std::array<int, 4> ClosedGround::neighbors(int cell) const {
  const int columns = routes_.grid.columns;
  const int column = cell % columns;
  return {column > 0 ? cell - 1 : -1, column < columns - 1 ? cell + 1 : -1, cell - columns,
          cell / columns < routes_.grid.rows - 1 ? cell + columns : -1};
}

std::vector<int> ClosedGround::traced(int cell, const std::vector<int>& before) {
  std::vector<int> cells{cell};
  while (before[static_cast<std::size_t>(cell)] != cell) {
    cell = before[static_cast<std::size_t>(cell)];
    cells.push_back(cell);
  }
  std::reverse(cells.begin(), cells.end());
  return cells;
}

std::optional<Vector2d> ClosedGround::wall_from(const Vector2d& at, const Vector2d& along,
                                                double enough_m) const {
  const double step_m = 0.5 * cell_m();
  for (double s = step_m; s < enough_m; s += step_m) {
    const int cell = routes_.cell_at(at + s * along);
    if (cell == Routes::kNone) return std::nullopt;
    if (free_[static_cast<std::size_t>(cell)] == 0) return at + s * along;
  }
  return std::nullopt;
}

bool ClosedGround::keeps_all(const Cells& seen, const Cells& reached) const {
  const auto is_cut_off = [&](int cell) {
    const auto index = static_cast<std::size_t>(cell);
    return reached[index] != 0 && seen[index] == 0;
  };
  return std::none_of(inner_.begin(), inner_.end(), is_cut_off) &&
         std::none_of(people_.begin(), people_.end(),
                      [&](int cell) { return is_free(cell) && is_cut_off(cell); });
}

}  // namespace throng::scenarios
