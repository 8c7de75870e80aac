// Geometry that is right and looks odd: edges of roofs, boxes that are cut off, doors on the
// horizon, drones that touch something. Checks must let it pass, and find it damaged all the same.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/files/files.h"
#include "checks/run_checks.h"
#include "checks/shot.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"

namespace throng::checks {
namespace {

using formats::hand_made::any_with;
using nlohmann::json;
using ::testing::IsEmpty;

/// A block of 8 x 8 x 10 m with its middle at (0, y), from 30 m above the origin; rays meet its
/// roof, its walls or the ground.
Shot block_from_above(double y_m, double pitch_rad, double depth_factor = 1) {
  constexpr int kSide = 160;
  Shot shot;
  shot.image = formats::hand_made::image();
  shot.image.width = shot.image.height = kSide;
  shot.camera.intrinsics = camera::intrinsics_from_hfov(kSide, kSide, 1.2);
  shot.camera.pose = camera::pose_looking({0, 0, 30}, 0.5 * EIGEN_PI, pitch_rad);
  Pixels& pixels = shot.pixels;
  pixels.width = pixels.height = kSide;
  const Eigen::Vector3d center = shot.camera.pose.center();
  const Eigen::AlignedBox3d block(Eigen::Vector3d(-4, y_m - 4, 0), Eigen::Vector3d(4, y_m + 4, 10));
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const Eigen::Vector3d ray = shot.camera.unproject({u, v}, 1) - center;
      double enter = 0;
      double leave = 1e9;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (block.min()[axis] - center[axis]) / ray[axis];
        const double b = (block.max()[axis] - center[axis]) / ray[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      const bool is_block = enter < leave;
      const double z = is_block ? depth_factor * enter : -center.z() / ray.z();
      pixels.ids.push_back(is_block ? formats::kFirstBuilding : formats::kGround);
      pixels.depth_cm.push_back(static_cast<std::uint16_t>(std::lround(100 * z)));
    }
  }
  return shot;
}

std::vector<std::string> building_faults(const Shot& shot) {
  return found_by([&](Findings& findings) { check_buildings(shot, findings); });
}

TEST(SoundGeometry, RoofsHaveGroundBesideThemThatIsFarBelow) {
  // Nearly straight down: the camera is before, above and behind the block, whose near wall is
  // seen, none is, and whose roof covers the wall at its lower side.
  for (const double y_m : {12.0, 0.0, -9.0, -12.0}) {
    EXPECT_THAT(building_faults(block_from_above(y_m, -1.36)), IsEmpty()) << y_m;
    EXPECT_THAT(building_faults(block_from_above(y_m, -0.5 * std::acos(-1.0))), IsEmpty()) << y_m;
  }
}

TEST(SoundGeometry, WallsEndOnTheGroundHoweverTheyAreSeen) {
  for (const double y_m : {12.0, -12.0}) {
    for (const double pitch_rad : {-1.36, -0.5 * std::acos(-1.0)}) {
      EXPECT_TRUE(any_with(building_faults(block_from_above(y_m, pitch_rad, 0.95)),
                           "buildings stand on the ground at"))
          << y_m << " " << pitch_rad;
    }
  }
}

/// A camera 2.2 m above the ground and somebody below it, 0.15 to 0.85 m ahead: their top is in row
/// 40 + 50 * 0.4 / 0.85 = 64, their middle in row 170, which is beyond two heights of the image,
/// where bbox_amodal is cut off.
formats::Image with_cut_box() {
  formats::Image image = formats::hand_made::image();
  image.t = -image.R * Eigen::Vector3d(0, 0, 2.2);
  formats::Person near = formats::hand_made::person(3, {20, 70, 60, 10}, {-30, 64, 160, 96}, 1);
  near.position = {0, 0.5, 0};
  near.box_middle = {0, 0.5, 0.9};
  near.box_size = {0.5, 0.7, 1.8};
  image.people = {near};
  return image;
}

TEST(SoundGeometry, BoxesAreCutOffOneImageSizeBeyondTheBorders) {
  const auto faults = [](const formats::Image& image) {
    return found_by([&](Findings& findings) { check_bodies(image, findings); });
  };
  formats::Image image = with_cut_box();
  EXPECT_FALSE(any_with(faults(image), "box-3d"));
  image.people[0].amodal = {-30, 64, 160, 60};
  EXPECT_TRUE(any_with(faults(image), "the middle of box_3d does not project into bbox_amodal"));
  // Astride the camera's plane nothing can be said; behind it there is nothing to see.
  image = with_cut_box();
  image.people[0].box_middle.y() = image.people[0].position.y() = 0;
  EXPECT_FALSE(any_with(faults(image), "box-3d"));
  image.people[0].box_middle.y() = image.people[0].position.y() = -3;
  EXPECT_TRUE(any_with(faults(image), "box_3d is behind the camera"));
}

TEST(SoundGeometry, PointsMoveIntoTheLimitOfBoxes) {
  formats::Image image = formats::hand_made::image();
  EXPECT_EQ(formats::in_amodal_limit(image, {50, 40}), Eigen::Vector2d(50, 40));
  EXPECT_EQ(formats::in_amodal_limit(image, {-150, 900}), Eigen::Vector2d(-100, 160));
  EXPECT_TRUE(formats::reaches_amodal_limit(image, {-100, 10, 5, 5}));
  EXPECT_FALSE(formats::reaches_amodal_limit(image, {-99, 10, 5, 5}));
  image.record["camera"]["model"] = "fisheye";
  EXPECT_EQ(formats::in_amodal_limit(image, {-150, 900}), Eigen::Vector2d(-25, 100));
}

/// A door 2 m wide, `y_m` ahead on the ground, as the camera of the image sees it, rounded.
json door_at(const formats::Image& image, double y_m, double shift_m = 0) {
  json polygon = json::array();
  for (const auto& [x, y] : {std::pair(-1.0, y_m), std::pair(1.0, y_m), std::pair(1.0, y_m + 0.5),
                             std::pair(-1.0, y_m + 0.5)}) {
    const Eigen::Vector3d seen =
        image.camera_matrix * (image.R * Eigen::Vector3d(x + shift_m, y, 0) + image.t);
    const auto rounded = [](double v) { return std::round(100 * (v + 0.5)) / 100; };
    polygon.push_back({rounded(seen.x() / seen.z()), rounded(seen.y() / seen.z())});
  }
  return polygon;
}

std::vector<std::string> door_faults(double first_height_m, double shift_m) {
  const throng::testing::TemporaryFolder folder;
  return found_by([&](Findings& findings) {
    ExitsCheck check;
    for (const double height_m : {first_height_m, 40.0}) {
      formats::Image image = formats::hand_made::image();
      image.t = -image.R * Eigen::Vector3d(0, 0, height_m);
      image.record["exits"] =
          json::array({{{"id", "north"},
                        {"state", "idle"},
                        {"door", door_at(image, 60, height_m == first_height_m ? 0 : shift_m)},
                        {"zone", json::array()}}});
      check.add(formats::hand_made::info(folder.path()), image, findings);
    }
  });
}

TEST(SoundGeometry, DoorsNearTheHorizonAreKnownAsWellAsTheyAreWritten) {
  // From 0.3 m above the ground a hundredth of a pixel is meters along the ground.
  EXPECT_FALSE(any_with(door_faults(0.3, 0), "exit-polygons"));
  EXPECT_FALSE(any_with(door_faults(30, 0), "exit-polygons"));
  EXPECT_TRUE(any_with(door_faults(30, 1), "exit-polygons"));
}

}  // namespace
}  // namespace throng::checks
