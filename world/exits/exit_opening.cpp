#include "world/exits/exit_opening.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::world {

using Eigen::Vector2d;

namespace {

constexpr double kDepthM = 0.5;
constexpr double kMinLaneM = 0.3;
constexpr double kRoundingM = 1e-3;

using Span = std::pair<double, double>;  ///< along a line, m
using Outline = std::vector<Vector2d>;

/// The outlines of buildings near an exit, as (along the exit's line from its first end, outward).
std::vector<Outline> outlines_near(const Exit& exit, const std::vector<Building>& buildings) {
  const Vector2d along = (exit.to - exit.from).normalized();
  const geometry::Rectangle near{Vector2d(0, -kDepthM), Vector2d(exit.length_m(), kDepthM)};
  std::vector<Outline> outlines;
  for (const Building& building : buildings) {
    Outline outline;
    for (const Vector2d& corner : building.footprint) {
      const Vector2d offset = corner - exit.from;
      outline.emplace_back(offset.dot(along), offset.dot(exit.outward));
    }
    if (geometry::bounding_box(outline).meets(near)) outlines.push_back(std::move(outline));
  }
  return outlines;
}

/// The parts of a parallel of the line, at a distance outward from it, that an outline covers.
void add_covered(const Outline& outline, double outward_m, std::vector<Span>& covered) {
  std::vector<double> cuts_m;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[i + 1 < outline.size() ? i + 1 : 0];
    if ((a.y() > outward_m) == (b.y() > outward_m)) continue;
    cuts_m.push_back(a.x() + (outward_m - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(cuts_m.begin(), cuts_m.end());
  for (std::size_t i = 0; i + 1 < cuts_m.size(); i += 2) {
    covered.emplace_back(cuts_m[i], cuts_m[i + 1]);
  }
}

/// The free lanes of a parallel of the exit's line.
std::vector<Span> free_lanes(const std::vector<Outline>& outlines, double outward_m,
                             double length_m) {
  std::vector<Span> covered;
  for (const Outline& outline : outlines) add_covered(outline, outward_m, covered);
  std::sort(covered.begin(), covered.end());
  std::vector<Span> lanes;
  double free_from_m = 0;
  covered.emplace_back(length_m, length_m);
  for (const auto& [from_m, to_m] : covered) {
    const double until_m = std::min(from_m, length_m);
    if (until_m - free_from_m >= kMinLaneM) lanes.emplace_back(free_from_m, until_m);
    free_from_m = std::max(free_from_m, to_m);
  }
  return lanes;
}

double total_m(const std::vector<Span>& lanes) {
  return std::accumulate(lanes.begin(), lanes.end(), 0.0, [](double sum_m, const Span& lane) {
    return sum_m + lane.second - lane.first;
  });
}

/// The lanes of the narrowest parallel. Between the distances of two corners the covered parts
/// change linearly; the middle stands for all of them.
std::vector<Span> narrowest_lanes(const std::vector<Outline>& outlines, double length_m) {
  std::vector<double> distances_m = {-kDepthM, kDepthM};
  for (const Outline& outline : outlines) {
    for (const Vector2d& corner : outline) {
      if (std::abs(corner.y()) < kDepthM) distances_m.push_back(corner.y());
    }
  }
  std::sort(distances_m.begin(), distances_m.end());
  std::vector<Span> narrowest = {{0, length_m}};
  for (std::size_t i = 0; i + 1 < distances_m.size(); ++i) {
    if (distances_m[i + 1] - distances_m[i] < kRoundingM) continue;
    std::vector<Span> lanes =
        free_lanes(outlines, 0.5 * (distances_m[i] + distances_m[i + 1]), length_m);
    if (total_m(lanes) < total_m(narrowest)) narrowest = std::move(lanes);
  }
  return narrowest;
}

}  // namespace

void trim_to_openings(const std::vector<Building>& buildings, std::vector<Exit>& exits) {
  for (Exit& exit : exits) {
    const double length_m = exit.length_m();
    if (length_m < kMinLaneM) continue;
    const std::vector<Span> lanes = narrowest_lanes(outlines_near(exit, buildings), length_m);
    const double free_m = total_m(lanes);
    if (lanes.empty() || free_m > length_m - kRoundingM) continue;
    const Vector2d along = (exit.to - exit.from) / length_m;
    const Vector2d first = exit.from;
    exit.from = first + lanes.front().first * along;
    exit.to = first + lanes.back().second * along;
    if (free_m < exit.length_m() - kRoundingM) exit.free_m = free_m;
    exit.drawn_m = length_m;
  }
}

}  // namespace throng::world
