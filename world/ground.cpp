#include "world/ground.h"

#include <algorithm>
#include <utility>

#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"

namespace throng::world {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

std::vector<Polygon> water_parts(std::span<const GroundArea> areas, std::size_t after) {
  std::vector<Polygon> parts;
  const std::size_t first = after < areas.size() ? after + 1 : 0;
  for (std::size_t i = first; i < areas.size(); ++i) {
    const GroundArea& area = areas[i];
    if (area.material != "water") continue;
    for (const auto& [a, b, c] : geometry::triangulate(area.corners)) {
      parts.push_back({area.corners[a], area.corners[b], area.corners[c]});
    }
  }
  return parts;
}

namespace {

/// A side of a convex polygon: what is inside has dot(left) above the limit.
struct HoleSide {
  HoleSide(const Polygon& hole, std::size_t i)
      : from(hole[i]), along((hole[(i + 1) % hole.size()] - from).normalized()) {}

  /// Distance of a point outside of it.
  double outside(const Vector2d& point) const { return geometry::cross(point - from, along); }

  Vector2d from;
  Vector2d along;
};

/// Whether a side of a convex hole has all of a polygon outside of it.
bool is_apart(const Polygon& polygon, const Polygon& hole) {
  constexpr double kSharedEdgeM = 1e-6;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const HoleSide side(hole, i);
    if (std::all_of(polygon.begin(), polygon.end(),
                    [&](const Vector2d& p) { return side.outside(p) > -kSharedEdgeM; })) {
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
        const HoleSide side(hole, i);
        Polygon outside =
            geometry::clipped(rest, [&](const Vector2d& p) { return -side.outside(p); });
        if (outside.size() >= 3 && geometry::signed_area(outside) > 1e-6) {
          kept.push_back(std::move(outside));
        }
        rest = geometry::clipped(rest, [&](const Vector2d& p) { return side.outside(p); });
      }
    }
    pieces = std::move(kept);
  }
  return pieces;
}

std::vector<Polygon> open_water(std::span<const GroundArea> areas) {
  std::vector<Polygon> open;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (areas[i].material != "water") continue;
    std::vector<Polygon> decks;
    for (std::size_t k = i + 1; k < areas.size(); ++k) {
      if (areas[k].material == "water") continue;
      for (const auto& [a, b, c] : geometry::triangulate(areas[k].corners)) {
        decks.push_back({areas[k].corners[a], areas[k].corners[b], areas[k].corners[c]});
      }
    }
    for (const auto& [a, b, c] : geometry::triangulate(areas[i].corners)) {
      for (Polygon& part :
           without({areas[i].corners[a], areas[i].corners[b], areas[i].corners[c]}, decks)) {
        open.push_back(std::move(part));
      }
    }
  }
  return open;
}

double surface_level_m(std::span<const GroundArea> areas, const Vector2d& point) {
  for (std::size_t i = areas.size(); i-- > 0;) {
    const GroundArea& area = areas[i];
    if (geometry::signed_distance_to(area.corners, point) < 0) return area.level_m;
  }
  return 0;
}

}  // namespace throng::world
