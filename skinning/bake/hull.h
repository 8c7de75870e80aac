// Lower levels of detail: the dressed person as one closed surface, simplified to any number of
// triangles and colored by images of the person.
//
// The simplification of garments fails below some thousand triangles (seams and open borders cannot
// collapse), and hulls offset from the skin turn skirts into leggings. A closed outer surface
// avoids both problems, and all its triangles serve the silhouette, since borders of colors are in
// the images.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "skinning/bake/carving.h"
#include "skinning/bake/extent.h"
#include "skinning/bake/portrait.h"
#include "skinning/image.h"
#include "skinning/population.h"
#include "skinning/wardrobe/dress.h"

namespace throng::skinning {

/// The closed surface of one dressed person.
class Hull {
 public:
  /// `textures` contains the textures of the person's surfaces, by key; the portrait's images have
  /// `image_size` pixels along each side. `person` must outlive this object.
  Hull(const DressedPerson& person, const std::map<std::string, Image>& textures, int image_size);

  const Portrait& portrait() const { return portrait_; }

  /// A mesh with at most, and about, this number of triangles; `image` is the texture index of the
  /// first of the portrait's two images.
  Mesh level(std::size_t triangles, int image) const;

  /// How a level is fitted.
  struct Fit {
    float slack_m;  ///< within which it reaches as far
    std::size_t max_triangles;
    std::size_t pose_count;  ///< of the extent's poses
  };
  /// A level that reaches as far as `extent`, with a quarter more triangles as often as it needs
  /// them for that.
  Mesh level(std::size_t triangles, int image, const Extent& extent, const Fit& fit) const;

 private:
  /// Skinning weights of a point of the surface: the mean of the nearest points of the dressed
  /// person.
  BoneWeights weights_at(const Eigen::Vector3f& point) const;
  void fit(ClosedSurface& coarse) const;

  /// A simplified surface and its points as the person stands.
  struct Simplified {
    ClosedSurface surface;
    std::vector<Eigen::Vector3f> standing;
    std::vector<BoneWeights> weights;
  };
  Simplified standing_surface(std::size_t triangles) const;
  Mesh mesh_of(const Simplified& simple, int image) const;

  const DressedPerson* person_;
  Palette apart_;  ///< from the A-pose to the pose of the hull
  std::vector<PosedSurface> posed_;
  Portrait portrait_;
  Carving carving_;
  ClosedSurface fine_;
};

}  // namespace throng::skinning
