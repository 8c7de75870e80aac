// A person's outer shape as one closed surface: the visual hull (Laurentini 1994), the largest
// shape with the same silhouettes.
//
// The hull contains skirts, coats, hats, hair and trousers as they appear, independently of their
// surfaces, and preserves the person's silhouettes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/bake/outline.h"
#include "skinning/bake/posed.h"

namespace throng::skinning {

/// Triangles over points (m), counter-clockwise from outside.
struct ClosedSurface {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint32_t> indices;
};

/// The signed distance from the hull, sampled on a grid.
class Carving {
 public:
  /// Carves by silhouettes from all around, horizontally and from above. Cavities that are visible
  /// only from below, such as the inside of a skirt, are filled. Painted surfaces are ignored.
  explicit Carving(std::span<const PosedSurface> surfaces);

  /// Distance (m) from the hull, negative inside, at most kFarM; accurate only near its surface.
  float distance_m(const Eigen::Vector3f& point) const;

  /// The hull's surface by surface nets (Gibson 1998), with triangles of about a centimeter.
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
