// Pictures of a dressed person that the lower levels of detail are coloured with.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "skinning/dress.h"
#include "skinning/image.h"

namespace throng::skinning {

/// A person in the A-pose, seen from the front (left half of the picture) and from behind (right
/// half), slightly from above so that crowns and shoulders show. Untinted and tinted parts go on
/// pictures of their own, each filled to its borders: colours cannot bleed into light and shade.
class Portrait {
 public:
  Portrait(const DressedPerson& person, const std::map<std::string, Image>& textures, int size);

  /// The untinted parts in their colours, or the tinted ones as light and shade.
  Image picture(bool tinted) const;

  /// Texture coordinates of a point of the A-pose, in [0, 1].
  Eigen::Vector2f uv_of(const Eigen::Vector3f& point, bool front) const;

 private:
  struct Texel {
    float depth = -1e9F;
    bool seen = false;
    bool tinted = false;
  };
  void draw(const Surface& surface, const Image& image, bool front);

  int size_;
  Eigen::Vector2f low_;  ///< corner of the view, the same for both sides
  Eigen::Vector2f extent_;
  Image colours_;
  std::vector<Texel> texels_;
};

/// The texel of an image at texture coordinates in [0, 1].
const std::uint8_t* texel_at(const Image& image, const Eigen::Vector2f& uv);

/// Texture coordinates within the triangle whose first index is at `at`.
Eigen::Vector2f uv_within(const Surface& surface, std::size_t at,
                          const Eigen::Vector3f& barycentric);

}  // namespace throng::skinning
