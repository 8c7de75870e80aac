// The outer surface of a dressed trunk, for straps around it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "skinning/wardrobe/dress.h"

namespace throng::skinning {

/// Skin and clothes of the trunk in the neutral stance, without arms, legs, head and hair.
class TrunkOutline {
 public:
  explicit TrunkOutline(const DressedPerson& person);

  struct Point {
    Eigen::Vector3f position;
    BoneWeights weights;
  };
  /// The outermost point of the trunk on a ray, or nothing if the ray misses it.
  std::optional<Point> outermost(const Eigen::Vector3f& origin,
                                 const Eigen::Vector3f& direction) const;

 private:
  struct Triangle {
    Eigen::Vector3f corner;
    Eigen::Vector3f to_b;
    Eigen::Vector3f to_c;
    BoneWeights weights;
  };
  std::vector<Triangle> triangles_;
};

}  // namespace throng::skinning
