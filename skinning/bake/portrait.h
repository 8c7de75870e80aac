// Images of a dressed person, the textures of the lower levels of detail.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/bake/posed.h"
#include "skinning/body/surface.h"
#include "skinning/image.h"

namespace throng::skinning {

/// A person from the front (left half of the images) and from behind (right half), slightly from
/// above, so that crown and shoulders are visible.
class Portrait {
 public:
  Portrait(std::span<const PosedSurface> surfaces, int size);

  /// The colors of parts that are not tinted, black elsewhere; see Tint::portrait.
  Image colors() const;
  /// The brightness of the tinted parts; see Tint::portrait.
  Image shades() const;

  /// Texture coordinates, in [0, 1], of a point in the same pose.
  Eigen::Vector2f uv_of(const Eigen::Vector3f& point, bool front) const;

 private:
  void draw(const PosedSurface& posed, bool front);

  int size_;
  Eigen::Vector2f low_;  ///< corner of the view, the same for both sides
  Eigen::Vector2f extent_;
  Image image_;  ///< filled to its borders; alpha is a Tint
  std::vector<float> depth_;
};

}  // namespace throng::skinning
