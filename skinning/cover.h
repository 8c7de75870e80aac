// What lies over a point of the skin.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "skinning/dress.h"
#include "skinning/image.h"

namespace throng::skinning {

struct Cover {
  float distance_m = 0;    ///< from the skin, along its normal
  Tint tint = Tint::none;  ///< of the outermost thing; none on bare skin
};

/// Everything that a person wears, in the A-pose.
class Clothing {
 public:
  Clothing(const DressedPerson& person, const std::map<std::string, Image>& textures);

  /// The outermost cover of a point of the skin, looking along its normal. `weights` tell the
  /// limb it is on: an arm is not covered by trousers.
  Cover over(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
             const BoneWeights& weights) const;

 private:
  enum class Limb : std::uint8_t { trunk, left_arm, right_arm, left_leg, right_leg };
  struct Triangle {
    Eigen::Vector3f corner;
    Eigen::Vector3f to_b;
    Eigen::Vector3f to_c;
    Limb limb;
    Tint tint;
    bool two_sided;
  };
  static Limb limb_of(const BoneWeights& weights);

  std::vector<Triangle> triangles_;
};

}  // namespace throng::skinning
