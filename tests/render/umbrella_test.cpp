// An umbrella hides its owner as a stranger's would: it has an id of its own, and nothing that is
// of the person holds it.
#include <gtest/gtest.h>

#include "tests/render/stage.h"

namespace throng::render {
namespace {

constexpr float kHalfM = 0.5F;

const RenderOptions kAllOfThem = {
    .quality = Quality::draft, .normals = true, .flow = true, .parts = true, .whole_masks = true};

class Umbrella : public ::testing::TestWithParam<Quality> {
 protected:
  static RenderOptions options() {
    RenderOptions options = kAllOfThem;
    options.quality = GetParam();
    return options;
  }

  Stage wet_{open_ground(), {}, options(), under_umbrellas(kHalfM)};
  Stage dry_{open_ground(), {}, options()};
};

camera::Camera from_above() { return camera_at({-4, 0, 6}, 0, -50, 640, 480); }

TEST_P(Umbrella, HidesItsOwnerAndIsNotTheirs) {
  const PersonInstance somebody = wet_.standing(6, 0.5, 0.2, 0.4);
  const Frame wet = wet_.draw(from_above(), {somebody});
  const Frame dry = dry_.draw(from_above(), {somebody});
  const PersonInView& truth = find_person(wet, 6);
  const PersonInView& bare = find_person(dry, 6);
  EXPECT_EQ(truth.amodal_area_px, bare.amodal_area_px);
  EXPECT_EQ(truth.amodal_box.min(), bare.amodal_box.min());
  EXPECT_EQ(truth.amodal_box.max(), bare.amodal_box.max());
  EXPECT_EQ(truth.box_size, bare.box_size);
  const std::uint64_t umbrella = instance_mask(wet, id_of_umbrella(6)).pixels;
  const std::uint64_t visible = instance_mask(wet, id_of_agent(6)).pixels;
  EXPECT_GT(umbrella, 1000U);
  EXPECT_GT(visible, 100U);
  EXPECT_LT(4 * visible, 3 * bare.amodal_area_px);
  EXPECT_EQ(instance_mask(dry, id_of_umbrella(6)).pixels, 0U);
  for (int y = 0; y < wet.height(); ++y) {
    for (int x = 0; x < wet.width(); ++x) {
      const std::size_t i = pixel_index(wet, x, y);
      ASSERT_EQ(truth.whole_mask->at(x, y), bare.whole_mask->at(x, y)) << x << ' ' << y;
      ASSERT_FALSE(is_umbrella(wet.id[i]) && wet.part[i] != 0) << x << ' ' << y;
    }
  }
}

TEST_P(Umbrella, IsNotCountedWhereItsOwnerLeavesTheImage) {
  const camera::Camera camera = camera_at({-2.2, 0, 2.2}, 0, -40, 320, 240);
  const PersonInstance somebody = wet_.standing(3, 0, 0.9, 0.4);
  const PersonInView truth = find_person(wet_.draw(camera, {somebody}), 3);
  const PersonInView bare = find_person(dry_.draw(camera, {somebody}), 3);
  ASSERT_GT(bare.amodal_area_px, 1000U);
  ASSERT_FALSE(Eigen::AlignedBox2d(Eigen::Vector2d(0, 0), Eigen::Vector2d(320, 240))
                   .contains(bare.amodal_box));
  EXPECT_EQ(truth.amodal_area_px, bare.amodal_area_px);
}

TEST_P(Umbrella, ThatComesIntoViewAloneDoesNotListItsOwner) {
  // Beside the camera: the canopy's corner reaches into the image, the body does not.
  const camera::Camera camera = camera_at({0, 0, 1.6}, 0, 0, 320, 240, 60);
  const Frame frame = wet_.draw(camera, {wet_.standing(1, 1, 1.2)});
  EXPECT_GT(instance_mask(frame, id_of_umbrella(1)).pixels, 50U);
  EXPECT_TRUE(frame.people.empty());
}

TEST_P(Umbrella, MovesWithItsOwner) {
  const PersonInstance here = wet_.standing(0, 0.5, 0, 0);
  PersonInstance there = here;
  there.position.y() += 0.1F;
  Scene now;
  now.people = {here};
  NeighborFrame next;
  next.scene.people = {there};
  next.camera = from_above();
  const Frame frame = wet_.renderer().draw(now, from_above(), &next);
  const Frame later = wet_.draw(from_above(), {there});
  const Mask before = instance_mask(frame, id_of_umbrella(0));
  const Mask after = instance_mask(later, id_of_umbrella(0));
  double moved_px = 0;
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (is_umbrella(frame.id[i])) moved_px += frame.flow[2 * i];
  }
  moved_px /= static_cast<double>(before.pixels);
  EXPECT_NEAR(moved_px, (after.box.center() - before.box.center()).x(), 1.0);
  EXPECT_LT(moved_px, -2);  // to the world's left is to the image's
}

TEST_P(Umbrella, APramHasItsClassAndNoneOfTheBodysMotion) {
  RenderOptions with_classes = options();
  with_classes.semantic = true;
  Stage stage{open_ground(), {}, with_classes, behind_prams()};
  PersonInstance somebody = stage.standing(4, 0.5, 0.2, 0.4);
  const Frame still = stage.draw(from_above(), {somebody});
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < still.id.size(); ++i) {
    const bool is_pram = is_umbrella(still.id[i]);
    ASSERT_EQ(is_pram,
              still.surface[i] == static_cast<std::uint8_t>(world::SemanticClass::stroller));
    ASSERT_TRUE(!is_pram || still.id[i] == id_of_umbrella(4));
    pixels += is_pram ? 1 : 0;
  }
  EXPECT_GT(pixels, 1000U);
  // From behind the box nothing of the body is before it.
  const camera::Camera front = camera_at({5, 0.2, 2}, 180, -15, 320, 240);
  somebody = stage.standing(4, 0, 0, 0);
  const Mask before = instance_mask(stage.draw(front, {somebody}), id_of_umbrella(4));
  somebody.pose = {3, 4, 0.5F};
  const Mask walking = instance_mask(stage.draw(front, {somebody}), id_of_umbrella(4));
  EXPECT_GT(before.pixels, 500U);
  EXPECT_EQ(walking.pixels, before.pixels);
  EXPECT_EQ(walking.box.min(), before.box.min());
}

INSTANTIATE_TEST_SUITE_P(Qualities, Umbrella, ::testing::Values(Quality::draft, Quality::standard),
                         [](const auto& tried) {
                           return tried.param == Quality::draft ? "draft" : "standard";
                         });

}  // namespace
}  // namespace throng::render
