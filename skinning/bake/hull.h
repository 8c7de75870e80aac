// Lower levels of detail: everything that a person wears as one closed surface, simplified to any
// number of triangles and colored by images of that person.
//
// Simplifying the garments themselves breaks down below some thousand triangles (seams and open
// borders cannot collapse), and hulls pushed out from the skin make leggings of skirts. One closed
// surface around the outside has neither trouble, and all its triangles go into the outline: where
// one color ends and another begins is in the images.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "skinning/bake/carving.h"
#include "skinning/bake/portrait.h"
#include "skinning/image.h"
#include "skinning/population.h"
#include "skinning/wardrobe/dress.h"

namespace throng::skinning {

class Hull {
 public:
  /// `textures` holds those of the person's surfaces; the images will have `image_size` pixels
  /// a side.
  Hull(const DressedPerson& person, const std::map<std::string, Image>& textures, int image_size);

  const Portrait& portrait() const { return portrait_; }

  /// With about this many triangles, and never more; `image` is the number of the first of the
  /// portrait's two images.
  Mesh level(std::size_t triangles, int image) const;

 private:
  /// Skinning weights of a surface point: the mean of those of the nearest worn points.
  BoneWeights weights_at(const Eigen::Vector3f& point) const;
  void fit(ClosedSurface& coarse) const;

  const DressedPerson* person_;
  Palette apart_;  ///< from the A-pose to the one the hull is made in
  std::vector<PosedSurface> posed_;
  Portrait portrait_;
  Carving carving_;
  ClosedSurface fine_;
};

}  // namespace throng::skinning
