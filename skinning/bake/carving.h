// A person's outer shape without what lies inside, as one closed surface: the visual hull
// (Laurentini 1994), which is all that no silhouette leaves out.
//
// Skirts, coats, hats, hair and trousers come out as they look, whatever surfaces they are made of,
// and what the hull is for is that its silhouettes stay what they were.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/bake/outline.h"
#include "skinning/bake/posed.h"

namespace throng::skinning {

/// Triangles over points, counter-clockwise seen from outside.
struct ClosedSurface {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint32_t> indices;
};

/// How far outside of the hull points are, sampled on a grid.
class Carving {
 public:
  /// Carves by silhouettes seen from all around, level and from above: what can only be seen from
  /// below, such as the hollow of a skirt, is filled. Painted surfaces do not count.
  explicit Carving(std::span<const PosedSurface> surfaces);

  /// Meters outside of the hull, negative inside, exact near its surface only and never more than
  /// kFarM.
  float distance_m(const Eigen::Vector3f& point) const;

  /// The hull's surface (surface nets, Gibson 1998), in triangles of about a centimeter.
  ClosedSurface surface() const;

  static constexpr float kFarM = Outline::kFarM;

 private:
  using Cell = std::array<int, 3>;
  std::size_t place(const Cell& cell) const;
  void drop_specks();
  void close_pinches();

  Eigen::Vector3f low_;
  Cell size_{};
  std::vector<float> distance_m_;
};

}  // namespace throng::skinning
