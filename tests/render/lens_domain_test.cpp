// Lenses whose models end within the image, and depth through any lens.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "base/compute/random.h"
#include "render/lens/lens.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using camera::Camera;
using camera::Distortion;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Model = Distortion::Model;

struct NamedLens {
  const char* name;
  double focal_px;  ///< of an image of 320 x 240
  Distortion distortion;
};

/// Lenses as calibrations give them: beyond a circle in the image they show nothing.
std::vector<NamedLens> cut_lenses() {
  return {
      {"fisheye of 190 degrees", 96, Distortion(Model::fisheye, {-0.05, 0.03, -0.04, 0.015})},
      {"fisheye that turns back", 150, Distortion(Model::fisheye, {-0.1, -0.05, 0.01, 0})},
      {"fisheye of a small field", 230, Distortion(Model::fisheye, {-0.3, -0.1, 0, 0})},
      {"barrel that turns back", 200, Distortion(Model::brown_conrady, {-0.5, 0.1})},
      {"barrel with tangential terms", 200,
       Distortion(Model::brown_conrady, {-0.5, 0.1, 0.01, -0.02})},
  };
}

Camera with(Camera camera, double focal_px, const Distortion& distortion) {
  camera.intrinsics.fx_px = focal_px;
  camera.intrinsics.fy_px = focal_px;
  camera.intrinsics.distortion = distortion;
  return camera;
}

class LensDomain : public testing::Test {
 protected:
  LensDomain() : stage_(open_ground({block(4, 5, -3, 0, 3)})) {}

  Frame draw(const Camera& camera, const std::vector<PersonInstance>& people) {
    Scene scene;
    scene.people = people;
    Lens lens(stage_.renderer(), stage_.people());
    return lens.draw(scene, camera);
  }

  std::vector<PersonInstance> crowd() const {
    std::vector<PersonInstance> people;
    for (std::uint32_t i = 0; i < 160; ++i) {
      Random random(11, Stream::crowd_generator, i);
      people.push_back(stage_.standing(i, random.uniform(-8, 12), random.uniform(-12, 12),
                                       random.uniform(-3, 3)));
    }
    return people;
  }

  Stage stage_;
};

TEST_F(LensDomain, PixelsOutsideOfTheModelAreBlackAndUnlabeled) {
  for (const NamedLens& each : cut_lenses()) {
    SCOPED_TRACE(each.name);
    const Camera camera = with(camera_at({-5, 0, 6}, 5, -50), each.focal_px, each.distortion);
    ASSERT_FALSE(shows_everywhere(camera.intrinsics));
    const std::vector<std::uint8_t> shown = shown_pixels(camera.intrinsics);
    const Frame frame = draw(camera, crowd());
    std::size_t dark = 0;
    std::map<std::uint32_t, Eigen::AlignedBox2d> visible;
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
      const Vector2d pixel(static_cast<double>(i % 320), static_cast<double>(i / 320));
      ASSERT_EQ(shown[i] != 0, camera.intrinsics.direction_of(pixel).has_value()) << i;
      if (is_agent(frame.id[i])) {
        visible[frame.id[i]].extend(pixel);
        visible[frame.id[i]].extend(Vector2d(pixel.array() + 1));
      }
      if (shown[i] != 0) continue;
      ++dark;
      ASSERT_EQ(frame.id[i], kIdNothing);
      ASSERT_TRUE(std::isinf(frame.depth_m[i]));
      ASSERT_EQ(frame.rgb[3 * i] + frame.rgb[3 * i + 1] + frame.rgb[3 * i + 2], 0);
    }
    EXPECT_GT(dark, frame.id.size() / 50);
    EXPECT_LT(dark, frame.id.size() * 3 / 4);
    EXPECT_GT(visible.size(), 5U);
    for (const PersonInView& person : frame.people) {
      EXPECT_GE(person.amodal_area_px, 0U);
      const auto found = visible.find(id_of_agent(person.agent));
      if (found == visible.end()) continue;
      Eigen::AlignedBox2d box = person.amodal_box;
      box.extend(Vector2d(box.min().array() - 1));
      box.extend(Vector2d(box.max().array() + 1));
      EXPECT_TRUE(box.contains(found->second)) << person.agent;
      visible.erase(found);
    }
    EXPECT_TRUE(visible.empty()) << "everybody who is visible is listed";
  }
}

TEST_F(LensDomain, PointsBeyondTheModelDoNotProject) {
  for (const NamedLens& each : cut_lenses()) {
    SCOPED_TRACE(each.name);
    const Camera camera = with(camera_at({-5, 0, 6}, 5, -50), each.focal_px, each.distortion);
    int seen = 0;
    int unseen = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      Random random(5, Stream::sensors, i);
      const Vector3d point(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(0, 2));
      const Camera::Projection place = camera.project(point);
      if (!place.visible) {
        ++unseen;
        continue;
      }
      ++seen;
      // The pixel shows the point: the model is monotonic up to there.
      EXPECT_LT((camera.unproject(place.pixel, place.depth_m) - point).norm(),
                1e-4 * place.depth_m + 1e-6)
          << point.transpose();
    }
    EXPECT_GT(seen, 1000);
    EXPECT_GT(unseen, 1000);
  }
}

TEST_F(LensDomain, KeypointsAreLabeledWhereTheModelReaches) {
  for (const NamedLens& each : cut_lenses()) {
    SCOPED_TRACE(each.name);
    const Camera camera = with(camera_at({-5, 0, 6}, 5, -50), each.focal_px, each.distortion);
    const Frame frame = draw(camera, crowd());
    int outside = 0;
    for (const PersonInView& person : frame.people) {
      const skinning::Keypoints seen = keypoints_in(person, camera);
      for (std::size_t k = 0; k < seen.size(); ++k) {
        const Vector3d ray = camera.pose.R * person.keypoints[k].cast<double>() + camera.pose.t;
        const bool is_reached =
            ray.z() > 0 && (ray.head<2>() / ray.z()).norm() <= each.distortion.limit();
        if (!is_reached) {
          ++outside;
          EXPECT_TRUE(seen[k].hasNaN());
        }
      }
    }
    EXPECT_GT(outside, 0);
  }
}

/// Intersection of a pixel's ray with the ground or the block, as its z in the camera's frame.
double true_depth(const Camera& camera, const Vector2d& pixel, std::uint32_t id) {
  const Vector3d from = camera.pose.center();
  const Vector3d direction = camera.unproject(pixel, 1) - from;
  if (id == kIdGround) return -from.z() / direction.z();
  const Eigen::AlignedBox3d box(Vector3d(4, -3, 0), Vector3d(5, 0, 3));
  double enter = 0;
  double leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - from[axis]) / direction[axis];
    const double b = (box.max()[axis] - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : std::nan("");
}

TEST_F(LensDomain, DepthIsThatOfThePixelsOwnRay) {
  std::vector<NamedLens> lenses = cut_lenses();
  lenses.push_back({"barrel", 250, Distortion(Model::brown_conrady, {-0.25, 0.06, 0.001, 0.002})});
  lenses.push_back({"pincushion", 250, Distortion(Model::brown_conrady, {0.2, 0.05})});
  lenses.push_back({"equidistant", 200, Distortion(Model::fisheye, {})});
  for (const NamedLens& each : lenses) {
    for (const double pitch_deg : {-75.0, -50.0, -25.0}) {
      SCOPED_TRACE(std::string(each.name) + " " + std::to_string(pitch_deg));
      const Camera camera =
          with(camera_at({-5, 0.3, 6}, 7, pitch_deg), each.focal_px, each.distortion);
      const Frame frame = draw(camera, {});
      std::size_t compared = 0;
      std::size_t off = 0;
      double worst = 0;
      for (std::size_t i = 0; i < frame.id.size(); ++i) {
        const std::uint32_t id = frame.id[i];
        if (id != kIdGround && id != kIdBuilding) continue;
        const Vector2d pixel(static_cast<double>(i % 320), static_cast<double>(i / 320));
        const double expected = true_depth(camera, pixel, id);
        if (!(expected > 0 && expected < 60)) continue;
        const double error = std::abs(static_cast<double>(frame.depth_m[i]) / expected - 1);
        ++compared;
        if (error > 1e-3) ++off;  // beside the block's edges
        if (id == kIdGround) worst = std::max(worst, error);
      }
      EXPECT_GT(compared, 5000U);
      EXPECT_LT(off, compared / 400);
      EXPECT_LT(worst, 2e-3) << "of the ground";
    }
  }
}

}  // namespace
}  // namespace throng::render
