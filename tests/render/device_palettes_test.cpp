#include "render/people/device_palettes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "base/compute/random.h"
#include "base/error.h"
#include "tests/render/synthetic_people.h"

namespace throng::render {
namespace {

constexpr std::uint64_t kPlenty = 1U << 27U;

// As shaders/person.vert.glsl does it.
skinning::BoneMatrix decoded(const DeviceBone& bone) {
  const auto value = [&](std::size_t word, bool high) {
    const auto bits = static_cast<std::uint16_t>(high ? bone[word] >> 16U : bone[word]);
    return static_cast<float>(static_cast<std::int16_t>(bits)) / 32767;
  };
  const Eigen::Quaternionf turn(value(1, true), value(0, false), value(0, true), value(1, false));
  skinning::BoneMatrix matrix;
  matrix.leftCols<3>() = turn.normalized().toRotationMatrix();
  matrix.col(3) = kMaxShiftM * Eigen::Vector3f(value(2, false), value(2, true), value(3, false));
  return matrix;
}

skinning::BoneMatrix any_motion(Random& random) {
  const auto between = [&](double low, double high) {
    return static_cast<float>(random.uniform(low, high));
  };
  Eigen::Vector3f axis(between(-1, 1), between(-1, 1), between(-1, 1));
  skinning::BoneMatrix matrix;
  matrix.leftCols<3>() =
      Eigen::AngleAxisf(between(-3.1, 3.1), axis.normalized()).toRotationMatrix();
  matrix.col(3) = Eigen::Vector3f(between(-3, 3), between(-3, 3), between(-3, 3));
  return matrix;
}

skinning::Population people_with(const std::vector<skinning::Palette>& palettes) {
  skinning::Population people = synthetic_people(1);
  people.palettes = palettes;
  people.palettes_per_character = static_cast<std::uint32_t>(palettes.size());
  return people;
}

TEST(DevicePalettes, AMillimeterIsNotLostTwoMetersAway) {
  Random random(7, Stream::motion);
  std::vector<skinning::Palette> palettes(200);
  for (skinning::Palette& palette : palettes) {
    for (skinning::BoneMatrix& matrix : palette) matrix = any_motion(random);
  }
  const std::vector<DeviceBone> bones = device_palettes(people_with(palettes), kPlenty);
  ASSERT_EQ(bones.size(), palettes.size() * skinning::kBoneCount);
  float worst_m = 0;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    const skinning::BoneMatrix& exact =
        palettes[i / skinning::kBoneCount][i % skinning::kBoneCount];
    const skinning::BoneMatrix device = decoded(bones[i]);
    for (const Eigen::Vector3f& point :
         {Eigen::Vector3f(2, 0, 0), Eigen::Vector3f(0, 2, 0), Eigen::Vector3f(0, 0, 2)}) {
      worst_m = std::max(worst_m, ((exact - device) * point.homogeneous()).norm());
    }
  }
  EXPECT_LT(worst_m, 0.0005F);
  EXPECT_GT(worst_m, 0);
}

TEST(DevicePalettes, TakeAThirdOfTheFloats) {
  const skinning::Population people = synthetic_people(3);
  EXPECT_EQ(3 * device_palettes(people, kPlenty).size() * sizeof(DeviceBone),
            people.palettes.size() * sizeof(skinning::Palette));
}

TEST(DevicePalettes, TooManyPeopleAreToldHowManyFit) {
  const skinning::Population people = synthetic_people(5);
  const std::uint64_t each =
      people.palettes_per_character * skinning::kBoneCount * sizeof(DeviceBone);
  EXPECT_NO_THROW(device_palettes(people, 5 * each));
  try {
    device_palettes(people, 5 * each - 1);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("5 of them"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("at most 4"), std::string::npos) << error.what();
  }
}

TEST(DevicePalettes, BentBonesAndDistantOnesAreRefused) {
  skinning::Population people = synthetic_people(1);
  skinning::BoneMatrix& bone = people.palettes[2][4];
  bone(0, 0) += 0.1F;
  EXPECT_THROW(device_palettes(people, kPlenty), InputError);
  people = synthetic_people(1);
  people.palettes[2][4].col(3).x() = 9;
  EXPECT_THROW(device_palettes(people, kPlenty), InputError);
}

}  // namespace
}  // namespace throng::render
