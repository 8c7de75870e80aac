// The signed distance from a person's silhouette.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "skinning/bake/posed.h"
#include "skinning/image.h"

namespace throng::skinning {

/// The silhouette of a person for a camera at infinity, with a resolution of a few millimeters.
class Outline {
 public:
  /// `yaw_rad` and `elevation_rad` are the direction from the person to the camera.
  Outline(std::span<const PosedSurface> surfaces, double yaw_rad, double elevation_rad);

  /// Distance (m) of the projected point from the silhouette, negative inside; at most kFarM.
  float distance_m(const Eigen::Vector3f& point) const;

  static constexpr float kFarM = 0.03F;

 private:
  void draw(const PosedSurface& posed, Mask& covered) const;
  std::vector<int> chamfer(const Mask& mask, std::uint8_t of) const;
  Mask grown(const Mask& mask, std::uint8_t value) const;
  void measure(const Mask& covered);

  Eigen::Matrix<float, 2, 3> to_image_;
  Eigen::Vector2f low_;
  int width_ = 0;
  int height_ = 0;
  std::vector<float> distance_m_;
};

}  // namespace throng::skinning
