#include "places/imports/gazebo/world_roads.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sdf/sdf.hh>

#include "places/imports/parts/areas.h"

namespace throng::imports {

std::optional<std::string> add_road(const sdf::ElementPtr& road, std::vector<FlatArea>& flat) {
  constexpr double kMaxCoordinateM = 5'000;
  constexpr double kMaxWidthM = 100;
  constexpr double kOnGroundM = 0.5;
  std::vector<Eigen::Vector2d> line;
  double highest = 0;
  if (road->HasElement("point")) {
    for (auto point = road->GetElement("point"); point; point = point->GetNextElement("point")) {
      const auto at = point->Get<ignition::math::Vector3d>();
      const bool is_near = std::abs(at.X()) <= kMaxCoordinateM &&
                           std::abs(at.Y()) <= kMaxCoordinateM && std::isfinite(at.Z());
      if (!is_near) return "a point more than 5 km away from the origin";
      line.emplace_back(at.X(), at.Y());
      highest = std::max(highest, std::abs(at.Z()));
    }
  }
  const auto width = road->Get<double>("width");
  if (!(width > 0 && width <= kMaxWidthM)) {
    return fmt::format("a width of {:g} m; roads are up to 100 m wide", width);
  }
  if (highest > kOnGroundM) {
    return fmt::format("leads {:.1f} m above or below the ground", highest);
  }
  const std::vector<Area> ground = along(line, width);
  if (ground.empty()) return "fewer than two points";
  for (const Area& area : ground) {
    for (Corners& corners : simple_parts(area)) {
      flat.push_back({highest, std::move(corners), "asphalt"});
    }
  }
  return std::nullopt;
}

}  // namespace throng::imports
