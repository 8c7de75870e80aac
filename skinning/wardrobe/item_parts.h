// The parts that items are made of: boxes with rounded edges, straps, rods and tires.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

#include "skinning/body/surface.h"
#include "skinning/wardrobe/dress.h"

namespace throng::skinning::items {

inline constexpr float kPi = std::numbers::pi_v<float>;

/// Places on the image of items: plain cloth on the upper right, dark straps and sticks below it,
/// black rubber at the bottom. Cloth with seams and a pocket is on the left half.
inline const Eigen::Vector2f kPlain(0.75F, 0.25F);
inline const Eigen::Vector2f kDark(0.75F, 0.68F);
inline const Eigen::Vector2f kBlack(0.75F, 0.93F);

/// The bone of parts that stay where they are in model space (kStillBone).
inline constexpr Bone kStill{kStillBone};

BoneWeights all_on(Bone bone);

/// Collects vertices and triangles of an item.
class Shape {
 public:
  std::uint32_t add(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                    const Eigen::Vector2f& uv, const BoneWeights& weights);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  Surface take();

 private:
  Surface surface_;
};

/// A box with rounded edges, a superellipsoid, around `center` with its axes turned by `turn`.
struct Box {
  Eigen::Vector3f center;
  Eigen::Vector3f half;  ///< m
  Bone bone;
  int rings;
  int columns;
  Eigen::Matrix3f turn = Eigen::Matrix3f::Identity();
};
void add_box(Shape& shape, const Box& box);

/// A point of a strap; `out` points away from what it lies on.
struct StrapPoint {
  Eigen::Vector3f position;
  Eigen::Vector3f out;
  BoneWeights weights;
};

/// A flat band along a path.
void add_strap(Shape& shape, const std::vector<StrapPoint>& path, float width_m, bool closed);

/// A rod with flat ends.
void add_rod(Shape& shape, const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius_m,
             Bone bone, const Eigen::Vector2f& uv = kDark, int sides = 4);

/// The tire of a wheel that rolls ahead and stays where it is in model space.
void add_tire(Shape& shape, const Eigen::Vector3f& center, float radius_m, float half_tube_m,
              int segments);

/// Frame of reference of an item.
struct Site {
  /// The first three levels of detail have shapes of their own, then several share one.
  static constexpr int kShapes = 5;

  const DressedPerson* person;
  float scale;  ///< 1 for a person of 1.7 m
  int shape;    ///< 0 is the finest

  const Eigen::Vector3f& joint(Bone bone) const { return person->joints[index_from(bone)]; }
  int of_shape(const std::array<int, kShapes>& numbers) const {
    return numbers[static_cast<std::size_t>(shape)];
  }
  int finer(int finest) const { return std::max(2, finest >> shape); }
};

}  // namespace throng::skinning::items
