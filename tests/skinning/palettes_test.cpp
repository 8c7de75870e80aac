#include "skinning/palettes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/compute/random.h"

namespace throng::skinning {
namespace {

BoneMatrix any_motion(Random& random) {
  const auto between = [&](double low, double high) {
    return static_cast<float>(random.uniform(low, high));
  };
  const Eigen::Vector3f axis(between(-1, 1), between(-1, 1), between(-1, 1));
  BoneMatrix matrix;
  matrix.leftCols<3>() =
      Eigen::AngleAxisf(between(-3.1, 3.1), axis.normalized()).toRotationMatrix();
  matrix.col(3) = Eigen::Vector3f(between(-3, 3), between(-3, 3), between(-3, 3));
  return matrix;
}

TEST(Palettes, AMillimeterIsNotLostTwoMetersAway) {
  Random random(7, Stream::motion);
  Palettes packed;
  float worst_m = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    Palette exact;
    for (BoneMatrix& matrix : exact) matrix = any_motion(random);
    packed.push_back(exact);
    const Palette found = packed[i];
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      for (const Eigen::Vector3f& point :
           {Eigen::Vector3f(2, 0, 0), Eigen::Vector3f(0, 2, 0), Eigen::Vector3f(0, 0, 2)}) {
        worst_m = std::max(worst_m, ((exact[bone] - found[bone]) * point.homogeneous()).norm());
      }
    }
  }
  EXPECT_LT(worst_m, 0.0005F);
  EXPECT_GT(worst_m, 0);
}

TEST(Palettes, TakeAThirdOfTheFloats) {
  Random random(8, Stream::motion);
  Palette palette;
  for (BoneMatrix& matrix : palette) matrix = any_motion(random);
  Palettes packed;
  packed.append(std::vector<Palette>(5, palette));
  EXPECT_EQ(packed.size(), 5U);
  EXPECT_EQ(3 * packed.bones().size_bytes(), 5 * sizeof(Palette));
}

TEST(Palettes, BentBonesAndDistantOnesAreRefused) {
  Random random(9, Stream::motion);
  Palette palette;
  for (BoneMatrix& matrix : palette) matrix = any_motion(random);
  Palette bent = palette;
  bent[4](0, 0) += 0.1F;
  Palette distant = palette;
  distant[4].col(3).x() = 9;
  Palettes packed;
  EXPECT_DEATH(packed.push_back(bent), "turned and moved");
  EXPECT_DEATH(packed.push_back(distant), "turned and moved");
}

}  // namespace
}  // namespace throng::skinning
