#include "places/scenarios/check/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/geometry/polygon.h"
#include "places/scenarios/check/closed_ground.h"

namespace throng::scenarios {

using Eigen::Vector2d;

namespace {

constexpr std::size_t kMaxGaps = 12;

/// The shortest line across each stretch of a way, from inside to outside.
std::vector<Chord> chords_across(const std::vector<int>& way, const ClosedGround& ground) {
  constexpr double kStretchM = 1;
  constexpr std::size_t kMaxStretches = 40;
  constexpr std::size_t kBesideLine = 3;  // the line takes one or two cells of the way
  const auto stretch =
      std::max({std::size_t{1}, static_cast<std::size_t>(kStretchM / ground.cell_m()),
                way.size() / kMaxStretches});
  std::vector<Chord> chords;
  for (std::size_t begin = 0; begin < way.size(); begin += stretch) {
    std::optional<Chord> best;
    for (std::size_t i = begin; i < std::min(begin + stretch, way.size()); ++i) {
      std::optional<Chord> chord = ground.shortest_chord(way[i]);
      if (!chord || (best && chord->length_m() >= best->length_m())) continue;
      if (!ground.leads_through(way, *chord)) continue;
      chord->at = i;
      chord->inner = way[i - std::min(i, kBesideLine)];
      best = chord;
    }
    if (best) chords.push_back(*best);
  }
  return chords;
}

double length_m(const std::vector<Chord>& lines) {
  return std::accumulate(lines.begin(), lines.end(), 0.0,
                         [](double sum, const Chord& line) { return sum + line.length_m(); });
}

std::vector<Chord> without(std::vector<Chord> lines, std::size_t index) {
  lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(index));
  return lines;
}

/// The lines without those of the first `count` that the others make needless.
std::vector<Chord> needed(std::vector<Chord> lines, std::size_t count, ClosedGround& ground) {
  for (std::size_t i = count; i-- > 0;) {
    std::vector<Chord> fewer = without(lines, i);
    ground.close(fewer);
    if (ground.way_out().empty()) lines = std::move(fewer);
  }
  return lines;
}

/// Lines that leave no way out but by the exits, each the shortest across a way; nothing where the
/// scenario cannot be closed.
std::optional<std::vector<Chord>> closing_lines(ClosedGround& ground) {
  std::vector<Chord> lines;
  for (std::vector<int> way = ground.way_out(); !way.empty(); way = ground.way_out()) {
    const Cells reached = ground.reached_from(way.front());
    std::vector<Chord> chords = chords_across(way, ground);
    std::stable_sort(chords.begin(), chords.end(),
                     [](const Chord& a, const Chord& b) { return a.length_m() < b.length_m(); });
    const auto shortest = std::find_if(chords.begin(), chords.end(), [&](const Chord& chord) {
      return ground.may_close(chord, reached);
    });
    if (shortest == chords.end() || lines.size() == kMaxGaps) return std::nullopt;
    lines.push_back(*shortest);
    ground.close(lines);
  }
  return needed(lines, lines.size(), ground);
}

/// Whether some lines enclose much more ground than others that are as many.
bool enclose_more(const std::vector<Chord>& lines, const std::vector<Chord>& others, int start,
                  ClosedGround& ground) {
  constexpr double kWorthIt = 1;  // of a square on the lines; a gap in a thick wall is less
  const auto area_m2 = [&](const std::vector<Chord>& closed) {
    ground.close(closed);
    const Cells reached = ground.reached_from(start);
    return static_cast<double>(std::count(reached.begin(), reached.end(), 1)) * ground.cell_m() *
           ground.cell_m();
  };
  return area_m2(lines) - area_m2(others) > kWorthIt * length_m(others) * length_m(others);
}

/// Puts a line farther out in place of others that are hardly shorter: obstacles before a gap
/// make several lines of it (`fewer`), and where all stand in a corner, a line across it is the
/// shortest. Returns whether it did.
bool move_outward(std::vector<Chord>& lines, bool fewer, ClosedGround& ground) {
  constexpr double kHardlyShorter = 1.5;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ground.close(without(lines, i));
    const std::vector<int> way = ground.way_out();
    const Cells reached = ground.reached_from(way.front());
    const std::vector<Chord> chords = chords_across(way, ground);
    const std::size_t at = ground.first_on(lines[i], way);
    for (auto chord = chords.rbegin(); chord != chords.rend() && chord->at > at; ++chord) {
      ground.close(without(lines, i));
      if (!ground.may_close(*chord, reached)) continue;
      std::vector<Chord> moved = lines;
      moved.push_back(*chord);
      moved = needed(std::move(moved), lines.size(), ground);
      const double spared_m = length_m(lines) - (length_m(moved) - chord->length_m());
      if (chord->length_m() > kHardlyShorter * spared_m) continue;
      if (moved.size() + (fewer ? 1 : 0) > lines.size()) continue;
      // Between parallel walls many lines are equally short.
      const bool is_as_short = chord->length_m() <= spared_m + ground.cell_m();
      if (!fewer && !is_as_short && !enclose_more(moved, lines, way.front(), ground)) continue;
      lines = std::move(moved);
      return true;
    }
  }
  return false;
}

using Wall = std::pair<Vector2d, Vector2d>;

/// The wall or door that is nearest to a point; the point itself where there is none.
Wall nearest_wall(const Vector2d& point, const LoadedCrowd& loaded, const ClosedGround& ground) {
  constexpr double kReachM = 1;  // of a person's radius and a few cells
  Wall nearest(point, point);
  double distance_m = kReachM;
  const auto consider = [&](const Vector2d& from, const Vector2d& to) {
    const double this_m = geometry::distance_to_segment(from, to, point);
    if (this_m >= distance_m) return;
    distance_m = this_m;
    nearest = {from, to};
  };
  for (const crowd::Segment& wall : loaded.crowd.obstacles.segments()) {
    consider(wall.begin.cast<double>(), wall.end.cast<double>());
  }
  for (const auto& [from, to] : ground.doors()) consider(from, to);
  return nearest;
}

/// The gap that a line closes, measured between the walls at its ends.
Gap gap_at(const Chord& line, const LoadedCrowd& loaded, const ClosedGround& ground) {
  const Wall a = nearest_wall(line.from, loaded, ground);
  const Wall b = nearest_wall(line.to, loaded, ground);
  Vector2d from = line.from;
  Vector2d to = line.to;
  for (int i = 0; i < 4; ++i) {  // to the places where they are nearest to each other
    from = geometry::nearest_on_segment(a.first, a.second, to);
    to = geometry::nearest_on_segment(b.first, b.second, from);
  }
  return {0.5 * (from + to), (to - from).norm()};
}

}  // namespace

OutlineSurvey survey_outline(const world::Scenario& scenario, const LoadedCrowd& loaded,
                             const Routes& routes) {
  ClosedGround ground(scenario, loaded, routes);
  OutlineSurvey survey;
  const std::vector<int> way = ground.way_out();
  if (way.empty()) return survey;
  ground.add_people(loaded);
  auto lines = closing_lines(ground);
  for (const bool fewer : {true, false}) {
    for (std::size_t i = 0; lines && i < kMaxGaps && move_outward(*lines, fewer, ground); ++i) {
    }
  }
  if (!lines) {
    survey.is_open = true;
    const auto leaves = std::find_if(way.begin(), way.end(), [&](int cell) {
      return !scenario.inside.contains(routes.cell_center(cell));
    });
    survey.open_at = routes.cell_center(leaves == way.end() ? way.back() : *leaves);
    return survey;
  }
  for (const Chord& line : *lines) survey.gaps.push_back(gap_at(line, loaded, ground));
  std::stable_sort(survey.gaps.begin(), survey.gaps.end(),
                   [](const Gap& a, const Gap& b) { return a.width_m > b.width_m; });
  return survey;
}

}  // namespace throng::scenarios
