// Other drones in the image: their rendered position, ground truth and motion.
#include <gtest/gtest.h>

#include <cmath>

#include "render/lens/exposure.h"
#include "render/lens/lens.h"
#include "render/truth/objects_in_view.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

constexpr std::uint32_t kOther = 1;
const Eigen::Vector3d kHigh(0, 0, 20);

/// The camera's own drone, and another that hovers 6 m below and 6 m ahead of it.
Scene two_drones(const Eigen::Vector3d& shift = Eigen::Vector3d::Zero(), double roll_rad = 0) {
  const AirframeShape shape = airframe_shape(*sim::find_airframe(std::string("f450")));
  Scene scene;
  scene.drones.push_back(
      {0, kHigh, Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity(), shape});
  scene.drones.push_back(
      {kOther, kHigh + Eigen::Vector3d(6, 0.4, -6) + shift, Eigen::Vector3d(1, 0, 0),
       Eigen::Quaterniond(Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX())), shape});
  return scene;
}

class Airframes : public testing::Test {
 protected:
  Airframes() : lens_(stage_.renderer(), stage_.people()) {}

  static RenderOptions all_truth() {
    RenderOptions options;
    options.flow = true;
    options.normals = true;
    return options;
  }

  Stage stage_{open_ground(), {}, all_truth()};
  Lens lens_;
};

TEST_F(Airframes, AreDrawnWhereTheirPoseProjects) {
  const camera::Camera camera = camera_at(kHigh, 0, -45, 640, 480, 50);
  const Frame frame = lens_.draw(two_drones(), camera);
  ASSERT_EQ(frame.objects.size(), 1U) << "a camera does not see what it hangs from";
  const ObjectInView& drone = frame.objects[0];
  EXPECT_EQ(drone.number, kOther);
  const Mask mask = instance_mask(frame, kIdDrone + kOther);
  ASSERT_GT(mask.pixels, 300U);
  // Nothing is in front: what is visible is all of it, to the rounding of corners.
  EXPECT_NEAR(static_cast<double>(mask.pixels), static_cast<double>(drone.amodal_area_px),
              0.02 * static_cast<double>(mask.pixels));
  EXPECT_LT((mask.box.min() - drone.amodal_box.min()).cwiseAbs().maxCoeff(), 1.01);
  EXPECT_LT((mask.box.max() - drone.amodal_box.max()).cwiseAbs().maxCoeff(), 1.01);
  const auto middle = camera.project(drone.position);
  EXPECT_TRUE(mask.box.contains(Eigen::Vector2d(middle.pixel.array() + 0.5)));
  // Body and blades are 0.25 m from the middle in depth at most.
  for (std::size_t i = 0; i < frame.id.size(); ++i) {
    if (frame.id[i] != kIdDrone + kOther) continue;
    EXPECT_NEAR(frame.depth_m[i], middle.depth_m, 0.35);
    EXPECT_NE(frame.normal[3 * i + 2], 0);
  }
}

TEST_F(Airframes, AreOneConnectedShape) {
  const camera::Camera camera =
      camera_at(kHigh + Eigen::Vector3d(4.8, 0.4, -4.8), 0, -45, 320, 320, 60);
  const Frame frame = lens_.draw(two_drones(), camera);
  // From every pixel of it one gets to the middle of the image through others.
  std::vector<char> reached(frame.id.size(), 0);
  std::vector<int> waiting;
  const auto visit = [&](int x, int y) {
    const std::size_t i = pixel_index(frame, x, y);
    if (frame.id[i] != kIdDrone + kOther || reached[i] != 0) return;
    reached[i] = 1;
    waiting.push_back(static_cast<int>(i));
  };
  visit(160, 160);
  while (!waiting.empty()) {
    const int at = waiting.back();
    waiting.pop_back();
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) visit(at % 320 + dx, at / 320 + dy);
    }
  }
  const auto connected = static_cast<std::uint64_t>(std::count(reached.begin(), reached.end(), 1));
  EXPECT_GT(connected, 1000U);
  EXPECT_GT(static_cast<double>(connected),
            0.95 * static_cast<double>(instance_mask(frame, kIdDrone + kOther).pixels));
}

TEST_F(Airframes, FlowCarriesThemAsTheyFlyAndTilt) {
  const camera::Camera camera = camera_at(kHigh, 0, -45, 640, 480, 40);
  NeighborFrame next{two_drones({0.3, 0.5, 0.1}, 0.2),
                     camera_at(kHigh + Eigen::Vector3d(0, -0.2, 0), 2, -44, 640, 480, 40)};
  next.scene.drones[0].position.y() -= 0.2;
  const Frame before = lens_.draw(two_drones(), camera, &next);
  const Frame after = lens_.draw(next.scene, next.camera);
  double sum = 0;
  int count = 0;
  for (int y = 0; y < before.height(); ++y) {
    for (int x = 0; x < before.width(); ++x) {
      const std::size_t i = pixel_index(before, x, y);
      if (before.id[i] != kIdDrone + kOther) continue;
      const auto to_x = static_cast<int>(std::lround(x + before.flow[2 * i]));
      const auto to_y = static_cast<int>(std::lround(y + before.flow[2 * i + 1]));
      ASSERT_TRUE(to_x >= 0 && to_y >= 0 && to_x < 640 && to_y < 480);
      sum += after.id[pixel_index(after, to_x, to_y)] == kIdDrone + kOther ? 1 : 0;
      ++count;
    }
  }
  ASSERT_GT(count, 300);
  EXPECT_GT(sum / count, 0.85) << "at the edges a carried pixel's middle may just miss";
}

TEST_F(Airframes, AreMeasuredThroughALensAndInStrips) {
  camera::Camera camera = camera_at(kHigh, 0, -45, 640, 480, 60);
  camera.intrinsics.distortion.emplace(camera::Distortion::Model::brown_conrady,
                                       camera::Distortion::Coefficients{-0.1, 0.02});
  const auto moment = [&](double time_s) {
    return ShutterMoment{std::make_shared<const Scene>(two_drones({0, 8 * time_s, 0})), camera};
  };
  for (const double readout_s : {0.0, 0.05}) {
    const Exposed exposed = expose(lens_, moment, 0, {0.02, readout_s}, {.next_s = 0.5});
    const Frame& frame = exposed.frame;
    ASSERT_EQ(frame.objects.size(), 1U);
    EXPECT_GT(exposed.samples, 1) << "it moves while the shutter is open";
    EXPECT_EQ(exposed.strips > 1, readout_s > 0);
    const Mask mask = instance_mask(frame, kIdDrone + kOther);
    const ObjectInView& drone = frame.objects[0];
    EXPECT_GT(mask.pixels, 200U);
    EXPECT_NEAR(static_cast<double>(mask.pixels), static_cast<double>(drone.amodal_area_px),
                0.03 * static_cast<double>(mask.pixels) + 4);
    EXPECT_LT((mask.box.min() - drone.amodal_box.min()).cwiseAbs().maxCoeff(), 1.5);
    EXPECT_LT((mask.box.max() - drone.amodal_box.max()).cwiseAbs().maxCoeff(), 1.5);
  }
}

TEST_F(Airframes, BehindABuildingAreNotVisibleButMeasured) {
  Stage stage(open_ground({block(2, 3, -10, 10, 21)}));
  Lens lens(stage.renderer(), stage.people());
  const Frame frame = lens.draw(two_drones(), camera_at(kHigh, 0, -45, 320, 240, 50));
  EXPECT_EQ(instance_mask(frame, kIdDrone + kOther).pixels, 0U);
  ASSERT_EQ(frame.objects.size(), 1U);
  EXPECT_GT(frame.objects[0].amodal_area_px, 50U);
}

}  // namespace
}  // namespace throng::render
