// Images of a dressed person that the lower levels of detail are colored with.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/bake/posed.h"
#include "skinning/body/surface.h"
#include "skinning/image.h"

namespace throng::skinning {

/// A person seen from the front (left half of the images) and from behind (right half), slightly
/// from above so that crowns and shoulders show.
class Portrait {
 public:
  Portrait(std::span<const PosedSurface> surfaces, int size);

  /// The parts that are not tinted in their colors, the others black; see Tint::portrait.
  Image colors() const;
  /// How bright the tinted parts are; see Tint::portrait.
  Image shades() const;

  /// Texture coordinates of a point of the same pose, in [0, 1].
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
