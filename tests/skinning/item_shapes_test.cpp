#include "skinning/wardrobe/item_shapes.h"

#include <gtest/gtest.h>

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

TEST(ItemShapes, NothingHasNoShape) {
  EXPECT_FALSE(make_item(Carry::nothing, boxy_person(), 0).has_value());
}

TEST(ItemShapes, EveryLevelHasTheItemWithFewerTriangles) {
  const DressedPerson person = boxy_person();
  for (const Carry carry : kCarried) {
    std::size_t before = 3 * 500;
    for (int level = 0; level < 4; ++level) {
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
    EXPECT_LE(before, 3 * 40U);
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
  const auto grip = find_grip(Carry::umbrella, person.joints);
  ASSERT_TRUE(grip.has_value());
  const auto item = make_item(Carry::umbrella, person, 0);
  float nearest = 1;
  for (const Eigen::Vector3f& point : item->positions) {
    nearest = std::min(nearest, (point - grip->point).norm());
  }
  EXPECT_LT(nearest, 0.04F);
  EXPECT_FALSE(find_grip(Carry::backpack, person.joints).has_value());
}

}  // namespace
}  // namespace throng::skinning
