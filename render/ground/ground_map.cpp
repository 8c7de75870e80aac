#include "render/ground/ground_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/polygon.h"

namespace throng::render {

using Eigen::Vector2d;

namespace {

Eigen::AlignedBox2d polygon_bounds(const std::vector<Vector2d>& corners) {
  Eigen::AlignedBox2d bounds;
  for (const Vector2d& corner : corners) bounds.extend(corner);
  return bounds;
}

}  // namespace

GroundMap::GroundMap(const world::Scenario& scenario) : scenario_(scenario) {
  for (const world::GroundArea& area : scenario.areas)
    areas_.push_back(polygon_bounds(area.corners));
  for (const world::Building& building : scenario.buildings) {
    buildings_.push_back(polygon_bounds(building.footprint));
  }
}

std::string_view GroundMap::material_at(const Vector2d& point) const {
  for (std::size_t i = scenario_.areas.size(); i-- > 0;) {
    const world::GroundArea& area = scenario_.areas[i];
    if (areas_[i].contains(point) && geometry::signed_distance_to(area.corners, point) < 0)
      return area.material;
  }
  return scenario_.ground.contains(point) ? std::string_view(scenario_.ground_material) : "";
}

double GroundMap::wall_m(const Vector2d& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < buildings_.size(); ++i) {
    if (buildings_[i].exteriorDistance(point) > nearest) continue;
    nearest =
        std::min(nearest, geometry::signed_distance_to(scenario_.buildings[i].footprint, point));
  }
  return nearest;
}

std::vector<GroundSegment> GroundMap::edges(
    const world::GroundArea& area,
    const std::function<bool(std::string_view outside)>& accepts) const {
  constexpr double kStepM = 0.5;
  constexpr double kOutsideM = 0.25;
  const std::vector<Vector2d>& corners = area.corners;
  std::vector<GroundSegment> found;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const GroundSegment side = {corners[i], corners[(i + 1) % corners.size()]};
    const int steps = std::max(1, static_cast<int>(std::lround(side.length_m() / kStepM)));
    const Vector2d step = (side.to - side.from) / steps;
    bool goes_on = false;
    for (int k = 0; k < steps; ++k) {
      const Vector2d middle = side.from + (k + 0.5) * step;
      const bool is_accepted = accepts(material_at(middle - kOutsideM * side.left())) &&
                               material_at(middle + kOutsideM * side.left()) == area.material;
      if (is_accepted && !goes_on) found.push_back({side.from + k * step, side.to});
      if (!is_accepted && goes_on) found.back().to = side.from + k * step;
      goes_on = is_accepted;
    }
  }
  return found;
}

std::vector<GroundSegment> GroundMap::road_edges() const {
  std::vector<GroundSegment> found;
  for (const world::GroundArea& area : scenario_.areas) {
    if (area.material != "asphalt") continue;
    const auto ends = edges(area, [&](std::string_view outside) {
      return area.kerb ? !outside.empty() && outside != area.material : is_paved(outside);
    });
    found.insert(found.end(), ends.begin(), ends.end());
  }
  return found;
}

}  // namespace throng::render
