#include "render/frame/view.h"

#include <gtest/gtest.h>

#include "base/compute/random.h"
#include "render/scenery/lighting.h"
#include "skinning/levels.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

TEST(ClipPlanes, HoldExactlyThePointsInTheImage) {
  const camera::Camera camera = camera_at({1, 2, 9}, 33, -40, 320, 200);
  const ClipPlanes planes = clip_planes(camera);
  int inside = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Random random(3, Stream::environment, i);
    const Eigen::Vector3d point(random.uniform(-20, 20), random.uniform(-20, 20),
                                random.uniform(0, 12));
    const camera::Camera::Projection seen = camera.project(point);
    const Eigen::Vector2d box = seen.pixel.array() + 0.5;
    const bool in_view =
        seen.depth_m > kNear && box.x() >= 0 && box.x() <= 320 && box.y() >= 0 && box.y() <= 200;
    EXPECT_EQ(!is_outside(planes, point, 0), in_view);
    inside += in_view ? 1 : 0;
  }
  EXPECT_GT(inside, 100);
}

TEST(LevelOfDetail, FollowsTheProjectedHeight) {
  const std::size_t levels = skinning::kDetailLevels.size();
  for (std::size_t i = 0; i + 1 < levels; ++i) {
    const double above_px = skinning::kDetailLevels[i].above_px;
    EXPECT_EQ(level_of_detail(above_px + 0.1, levels), i);
    EXPECT_EQ(level_of_detail(above_px + 0.1, levels + 3), i);
    if (above_px == 0) break;
    EXPECT_EQ(level_of_detail(above_px, levels), i + 1);
  }
  EXPECT_EQ(level_of_detail(10, 2), 1U);
  EXPECT_EQ(level_of_detail(10, 1), 0U);
}

TEST(VisiblePart, IsTheFootprintOfTheView) {
  const Eigen::AlignedBox2d place(Eigen::Vector2d(-100, -100), Eigen::Vector2d(100, 100));
  // Straight down from 10 m with 90 degrees across.
  const ClipPlanes down = clip_planes(camera_at({5, 0, 10}, 90, -90, 200, 100, 90));
  const Eigen::AlignedBox2d seen = visible_part(down, place, 0);
  EXPECT_TRUE(seen.isApprox({Eigen::Vector2d(-5, -5), Eigen::Vector2d(15, 5)}, 1e-9));
  const ClipPlanes up = clip_planes(camera_at({5, 0, 10}, 90, 60));
  EXPECT_TRUE(visible_part(up, place, 0).isEmpty());
}

TEST(ShadowArea, CoversTheViewAndMovesInWholeTexels) {
  const Eigen::AlignedBox2d place(Eigen::Vector2d(-60, -50), Eigen::Vector2d(60, 50));
  const Eigen::Vector2d slope = shadow_slope({});
  const auto area_from = [&](double x) {
    return shadow_area(clip_planes(camera_at({x, 0, 30}, 20, -50)), place, 10, slope);
  };
  const Eigen::AlignedBox2d here = area_from(0);
  const Eigen::AlignedBox2d near = area_from(0.013);
  EXPECT_TRUE(here.contains(visible_part(clip_planes(camera_at({0, 0, 30}, 20, -50)), place, 0)));
  EXPECT_NEAR(here.sizes().x(), near.sizes().x(), 1e-9) << "the size changes in steps only";
  const double texels = (near.min().x() - here.min().x()) / (here.sizes().x() / kShadowSize);
  EXPECT_NEAR(texels, std::round(texels), 1e-6);
}

}  // namespace
}  // namespace throng::render
