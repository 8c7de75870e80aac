#include "skinning/wardrobe/item_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "skinning/items.h"
#include "tests/skinning/made_up.h"

namespace throng::skinning {
namespace {

// A person whose trunk is a box.
DressedPerson boxy_person() {
  DressedPerson person;
  person.joints = made_up_joints();
  person.stature_m = 1.8F;
  Surface trunk;
  BoneWeights weights{};
  weights[index_from(Bone::chest)] = 1;
  for (const float x : {-0.1F, 0.1F}) {
    for (const float y : {-0.17F, 0.17F}) {
      for (const float z : {0.85F, 1.5F}) {
        trunk.source.push_back(static_cast<std::uint32_t>(trunk.source.size()));
        trunk.positions.push_back({x, y, z});
        trunk.normals.push_back(Eigen::Vector3f(x, y, 0).normalized());
        trunk.uvs.push_back({0, 0});
        trunk.weights.push_back(weights);
      }
    }
  }
  trunk.fitted = trunk.positions;
  // Corners are numbered 4 x + 2 y + z.
  trunk.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                   2, 3, 7, 2, 7, 6, 1, 5, 7, 1, 7, 3, 0, 2, 6, 0, 6, 4};
  person.surfaces.push_back(std::move(trunk));
  return person;
}

constexpr std::array kCarried = {Carry::backpack, Carry::shoulder_bag, Carry::handbag,
                                 Carry::umbrella};
constexpr std::array kLed = {Carry::suitcase, Carry::pram, Carry::bicycle};
constexpr std::array kItems = {Carry::backpack,      Carry::shoulder_bag, Carry::handbag,
                               Carry::umbrella,      Carry::suitcase,     Carry::pram,
                               Carry::walking_stick, Carry::bicycle};

TEST(ItemShapes, NothingHasNoShape) {
  EXPECT_FALSE(make_item(Carry::nothing, boxy_person(), 0).has_value());
}

TEST(ItemShapes, EveryLevelHasTheItemWithFewerTriangles) {
  const DressedPerson person = boxy_person();
  for (const Carry carry : kItems) {
    std::size_t before = is_led(carry) ? 3 * 1100 : 3 * 500;
    for (int level = 0; level < 7; ++level) {
      const auto item = make_item(carry, person, level);
      ASSERT_TRUE(item.has_value());
      EXPECT_EQ(item->tint, Tint::item);
      EXPECT_GT(item->indices.size(), 0U);
      EXPECT_LE(item->indices.size(), before) << static_cast<int>(carry) << " level " << level;
      before = item->indices.size();
      for (const std::uint32_t index : item->indices) ASSERT_LT(index, item->positions.size());
      for (const BoneWeights& weights : item->weights) {
        float sum = 0;
        for (const float weight : weights) sum += weight;
        EXPECT_NEAR(sum, 1, 1e-4);
      }
    }
    EXPECT_LE(before, is_led(carry) ? 3 * 100U : 3 * 40U) << static_cast<int>(carry);
  }
}

TEST(ItemShapes, HangWhereTheyBelong) {
  const DressedPerson person = boxy_person();
  for (const Carry carry : kCarried) {
    const auto item = make_item(carry, person, 3);
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const Eigen::Vector3f& point : item->positions) middle += point;
    middle /= static_cast<float>(item->positions.size());
    switch (carry) {
      case Carry::backpack:
        EXPECT_LT(middle.x(), -0.1F);
        EXPECT_NEAR(middle.y(), 0, 0.02);
        break;
      case Carry::shoulder_bag:
        EXPECT_LT(middle.y(), -0.05F);
        break;
      case Carry::handbag:
        EXPECT_LT(middle.z(), person.joints[index_from(Bone::right_hand)].z());
        EXPECT_GT(middle.z(), 0.3F);
        break;
      default:
        EXPECT_GT(middle.z(), person.stature_m);
    }
  }
}

TEST(ItemShapes, TheUmbrellasStickGoesThroughTheGrip) {
  const DressedPerson person = boxy_person();
  const std::vector<Grip> grips = find_grips(Carry::umbrella, person.joints);
  ASSERT_EQ(grips.size(), 1U);
  const auto item = make_item(Carry::umbrella, person, 0);
  float nearest = 1;
  for (const Eigen::Vector3f& point : item->positions) {
    nearest = std::min(nearest, (point - grips.front().point).norm());
  }
  EXPECT_LT(nearest, 0.04F);
  EXPECT_TRUE(find_grips(Carry::backpack, person.joints).empty());
}

TEST(ItemShapes, WheelsStandOnTheGroundAndHandlesAreInTheHands) {
  const DressedPerson person = boxy_person();
  for (const Carry carry : kLed) {
    for (int level = 0; level < 7; ++level) {
      const auto item = make_item(carry, person, level);
      Eigen::AlignedBox3f bounds;
      for (const Eigen::Vector3f& point : item->positions) bounds.extend(point);
      // Coarse wheels have corners.
      EXPECT_NEAR(bounds.min().z(), 0, level < 2 ? 0.01 : 0.05) << static_cast<int>(carry);
      for (const BoneWeights& weights : item->weights) EXPECT_EQ(weights[kStillBone], 1);
      for (const Grip& grip : find_grips(carry, person.joints)) {
        EXPECT_TRUE(bounds.contains(grip.point) || level > 2) << static_cast<int>(carry);
      }
    }
  }
}

TEST(ItemShapes, LedObjectsAreClosedAndShowTheirOutside) {
  const DressedPerson person = boxy_person();
  for (const Carry carry : {Carry::suitcase, Carry::pram, Carry::bicycle, Carry::walking_stick}) {
    const auto item = make_item(carry, person, 0);
    float volume = 0;
    std::size_t agreeing = 0;
    for (std::size_t at = 0; at < item->indices.size(); at += 3) {
      const std::array<std::uint32_t, 3> corner = {item->indices[at], item->indices[at + 1],
                                                   item->indices[at + 2]};
      const Eigen::Vector3f& a = item->positions[corner[0]];
      const Eigen::Vector3f& b = item->positions[corner[1]];
      const Eigen::Vector3f& c = item->positions[corner[2]];
      volume += a.dot(b.cross(c)) / 6;
      const Eigen::Vector3f mean =
          item->normals[corner[0]] + item->normals[corner[1]] + item->normals[corner[2]];
      agreeing += mean.dot((b - a).cross(c - a)) >= 0 ? 1 : 0;
    }
    EXPECT_GT(volume, 1e-4F) << static_cast<int>(carry);
    EXPECT_EQ(3 * agreeing, item->indices.size()) << static_cast<int>(carry);
    Eigen::Vector3f area = Eigen::Vector3f::Zero();  // that of a closed surface is none
    for (std::size_t at = 0; at < item->indices.size(); at += 3) {
      const Eigen::Vector3f& a = item->positions[item->indices[at]];
      area += (item->positions[item->indices[at + 1]] - a)
                  .cross(item->positions[item->indices[at + 2]] - a);
    }
    EXPECT_LT(area.norm(), 1e-3F) << static_cast<int>(carry);
  }
}

}  // namespace
}  // namespace throng::skinning
