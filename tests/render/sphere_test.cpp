// Spheres, rendered as a user's mesh, against analytic geometry: through pinholes and lenses.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "base/files/files.h"
#include "render/lens/lens.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using Eigen::Vector3d;

constexpr int kMeridians = 192;
constexpr int kParallels = 96;

/// A sphere of radius 1 as an OBJ file.
std::string sphere_obj() {
  std::string text;
  for (int row = 0; row <= kParallels; ++row) {
    const double down = std::numbers::pi * row / kParallels;
    for (int column = 0; column < kMeridians; ++column) {
      const double turn = 2 * std::numbers::pi * column / kMeridians;
      text += fmt::format("v {:.9f} {:.9f} {:.9f}\n", std::sin(down) * std::cos(turn),
                          std::cos(down), std::sin(down) * std::sin(turn));
    }
  }
  for (int row = 0; row < kParallels; ++row) {
    for (int column = 0; column < kMeridians; ++column) {
      const int beside = (column + 1) % kMeridians;
      const int a = row * kMeridians + 1;
      const int b = a + kMeridians;
      text += fmt::format("f {} {} {} {}\n", a + column, a + beside, b + beside, b + column);
    }
  }
  return text;
}

class Spheres : public testing::Test {
 protected:
  Spheres() {
    std::filesystem::create_directories(folder_);
    write_file_atomically(folder_ / "sphere.obj", sphere_obj());
    world::Scenario scenario = open_ground();
    scenario.meshes = {{folder_ / "sphere.obj", kMiddle, 0.4, kRadiusM}};
    stage_.emplace(std::move(scenario), Environment{}, RenderOptions{.quality = Quality::draft});
  }
  ~Spheres() override { std::filesystem::remove_all(folder_); }

  /// How far inside the sphere's outline a pixel's middle is, in pixels; where its ray meets the
  /// sphere, as the camera's z.
  struct Meeting {
    double inside_px;
    double depth_m;
  };
  static Meeting meeting(const camera::Camera& camera, int x, int y) {
    const Vector3d eye = camera.pose.center();
    const Vector3d ray = camera.unproject({x, y}, 1.0) - eye;
    const Vector3d to = kMiddle - eye;
    const double along = to.dot(ray) / ray.squaredNorm();
    const double off = (to - along * ray).norm();
    const double half = std::sqrt(std::max(kRadiusM * kRadiusM - off * off, 0.0)) / ray.norm();
    return {(kRadiusM - off) * camera.intrinsics.fy_px / to.norm(), along - half};
  }

  static inline const Vector3d kMiddle{9, 0.5, 2.2};
  static constexpr double kRadiusM = 1.6;
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("throng-sphere-" + std::to_string(::getpid()));
  std::optional<Stage> stage_;
};

TEST_F(Spheres, CoverTheirOutline) {
  for (const camera::Camera& camera :
       {camera_at({0, 0, 3}, 0, -5, 640, 480), camera_at({4, -6, 9}, 50, -45, 640, 480),
        camera_at({9.3, 0.4, 12}, 20, -90, 480, 480)}) {
    const Frame frame = stage_->draw(camera);
    int covered = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const auto [inside_px, depth_m] = meeting(camera, x, y);
        // The mesh is within 0.1 pixel of the sphere.
        if (std::abs(inside_px) < 0.2) continue;
        const std::size_t i = pixel_index(frame, x, y);
        ASSERT_EQ(frame.id[i] == kIdProp, inside_px > 0) << x << ' ' << y << ' ' << inside_px;
        if (inside_px < 3) continue;
        ASSERT_NEAR(frame.depth_m[i], depth_m, 0.01) << x << ' ' << y;
        ++covered;
      }
    }
    EXPECT_GT(covered, 10'000);
  }
}

TEST_F(Spheres, CoverTheirDistortedOutline) {
  Lens lens(stage_->renderer(), stage_->people());
  for (const camera::Distortion& distortion :
       {camera::Distortion(camera::Distortion::Model::brown_conrady, {-0.28, 0.08, 0.001}),
        camera::Distortion(camera::Distortion::Model::fisheye, {-0.04, 0.003})}) {
    camera::Camera camera = camera_at({2, 3, 4}, -32, -12, 640, 480);
    camera.intrinsics.distortion = distortion;
    const Frame frame = lens.draw({}, camera);
    double expected = 0;
    double drawn = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const double inside_px = meeting(camera, x, y).inside_px;
        const bool is_sphere = frame.id[pixel_index(frame, x, y)] == kIdProp;
        expected += inside_px > 0 ? 1 : 0;
        drawn += is_sphere ? 1 : 0;
        // Ids are those of the nearest pixel of a wider image.
        if (std::abs(inside_px) < 1) continue;
        ASSERT_EQ(is_sphere, inside_px > 0) << x << ' ' << y << ' ' << inside_px;
      }
    }
    EXPECT_GT(expected, 5000);
    EXPECT_NEAR(drawn / expected, 1, 0.003) << "as many too many as too few";
  }
}

}  // namespace
}  // namespace throng::render
