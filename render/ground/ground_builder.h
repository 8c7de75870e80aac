// Flat polygons on the ground, appended to the scenery's mesh.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "render/ground/scenery_mesh.h"

namespace throng::render {

/// A straight part of the ground's pattern, as of an area's edge (m).
struct GroundSegment {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();

  double length_m() const { return (to - from).norm(); }
  Eigen::Vector2d along() const { return (to - from).normalized(); }
  /// Unit vector to the left of the direction.
  Eigen::Vector2d left() const { return {-along().y(), along().x()}; }
};

class GroundBuilder {
 public:
  explicit GroundBuilder(SceneryMesh& mesh) : mesh_(mesh) {}

  std::uint32_t indices() const { return static_cast<std::uint32_t>(mesh_.indices.size()); }

  /// From now on vertices know how far they are from the outline of an area, if it is not narrow.
  void set_outline(std::span<const Eigen::Vector2d> outline);

  /// From now on SceneryVertex::local has coordinates along and to the left of the segment (m).
  void set_axes(const GroundSegment& axes) { axes_ = axes; }

  /// From now on vertices have ground_tone_at() times this.
  void set_tone(float tone) { tone_ = tone; }

  /// A convex polygon, counter-clockwise.
  void add(std::vector<Eigen::Vector2d> polygon, double height_m);

  /// The same cut along a grid, so that vertices know how far they are from the outline.
  void add_in_cells(const std::vector<Eigen::Vector2d>& polygon, double height_m);

  /// The strip to the left of a segment between two distances from it, with axes along it, in
  /// pieces: those of long thin triangles would be many once light is added (light/refine.h).
  void add_strip(const GroundSegment& segment, double near_m, double far_m, double height_m);

  /// The upright side of a stone on the ground, which shows to the right of the segment.
  void add_side(const GroundSegment& segment, double height_m);

 private:
  double inside_m(const Eigen::Vector2d& point) const;
  std::uint32_t add_vertex(const Eigen::Vector2d& point, double height_m,
                           const Eigen::Vector2d& facing);

  SceneryMesh& mesh_;
  std::span<const Eigen::Vector2d> outline_;
  float tone_ = 1;
  GroundSegment axes_ = {Eigen::Vector2d::Zero(), Eigen::Vector2d::UnitX()};
};

/// Parts of a segment that are at most a few meters long, one after the other.
std::vector<GroundSegment> in_pieces(const GroundSegment& segment);

/// The part of a convex polygon on the side of a line where normal . p <= limit.
std::vector<Eigen::Vector2d> cut(const std::vector<Eigen::Vector2d>& polygon,
                                 const Eigen::Vector2d& normal, double limit);

}  // namespace throng::render
