// Looks up the ground of a scenario: its material in a place, and where its edges run.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <string_view>
#include <vector>

#include "render/ground/ground_builder.h"
#include "world/scenario.h"

namespace throng::render {

class GroundMap {
 public:
  /// The scenario must outlive the map.
  explicit GroundMap(const world::Scenario& scenario);

  /// The material that shows on the ground: of the uppermost area; "" beyond the ground's edge.
  std::string_view material_at(const Eigen::Vector2d& point) const;

  /// Distance to the nearest building (m); negative inside of one.
  double wall_m(const Eigen::Vector2d& point) const;

  /// The parts of an area's sides, counter-clockwise, where it shows and the material outside of it
  /// is accepted.
  std::vector<GroundSegment> edges(
      const world::GroundArea& area,
      const std::function<bool(std::string_view outside)>& accepts) const;

  /// The kerbs of roads: where asphalt meets pavement, or all edges of those with `kerb`, but for
  /// those where it goes on.
  std::vector<GroundSegment> road_edges() const;

 private:
  const world::Scenario& scenario_;
  std::vector<Eigen::AlignedBox2d> areas_;      ///< bounds of each
  std::vector<Eigen::AlignedBox2d> buildings_;  ///< bounds of each
};

/// Whether kerb stones around an area stand up: nobody needs to walk over them.
inline bool is_bed(const world::GroundArea& area) {
  return area.kerb && (area.material == "grass" || area.material == "dirt");
}

/// Whether a material is a pavement for people on foot.
inline bool is_paved(std::string_view material) {
  return material == "pavers" || material == "concrete";
}

}  // namespace throng::render
