#include "render/ground/water_cuts.h"

#include <algorithm>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"
#include "render/ground/ground_builder.h"

namespace throng::render {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

std::vector<Polygon> water_parts(const world::Scenario& scenario, std::size_t after) {
  std::vector<Polygon> parts;
  const std::size_t first = after < scenario.areas.size() ? after + 1 : 0;
  for (std::size_t i = first; i < scenario.areas.size(); ++i) {
    const world::GroundArea& area = scenario.areas[i];
    if (area.material != "water") continue;
    for (const auto& [a, b, c] : geometry::triangulate(area.corners)) {
      parts.push_back({area.corners[a], area.corners[b], area.corners[c]});
    }
  }
  return parts;
}

namespace {

/// Whether a side of a convex hole has all of a polygon outside of it.
bool is_apart(const Polygon& polygon, const Polygon& hole) {
  constexpr double kTouchM = 1e-6;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const GroundSegment side = {hole[i], hole[(i + 1) % hole.size()]};
    if (std::all_of(polygon.begin(), polygon.end(),
                    [&](const Vector2d& p) { return side.left().dot(p - side.from) < kTouchM; })) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Polygon> without(const Polygon& polygon, const std::vector<Polygon>& holes) {
  std::vector<Polygon> pieces = {polygon};
  for (const Polygon& hole : holes) {
    std::vector<Polygon> kept;
    for (Polygon& piece : pieces) {
      if (is_apart(piece, hole)) {
        kept.push_back(std::move(piece));
        continue;
      }
      Polygon rest = std::move(piece);
      for (std::size_t i = 0; i < hole.size() && rest.size() >= 3; ++i) {
        const GroundSegment side = {hole[i], hole[(i + 1) % hole.size()]};
        const double limit = side.left().dot(side.from);
        Polygon outside = cut(rest, side.left(), limit);
        if (outside.size() >= 3 && geometry::signed_area(outside) > 1e-6) {
          kept.push_back(std::move(outside));
        }
        rest = cut(rest, -side.left(), -limit);
      }
    }
    pieces = std::move(kept);
  }
  return pieces;
}

double surface_level_m(const world::Scenario& scenario, const Vector2d& point) {
  for (std::size_t i = scenario.areas.size(); i-- > 0;) {
    const world::GroundArea& area = scenario.areas[i];
    if (geometry::signed_distance_to(area.corners, point) < 0) return area.level_m;
  }
  return 0;
}

}  // namespace throng::render
