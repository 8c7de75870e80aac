// Surfaces that nearly touch the camera: a drone that has landed or crashed sees the ground, a wall
// or somebody from a few centimeters, through any lens.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "render/lens/lens.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using camera::Camera;
using camera::Distortion;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Model = Distortion::Model;

const Eigen::AlignedBox3d kWall(Vector3d(4, -30, 0), Vector3d(24, 30, 40));

struct NearSurfaces : testing::Test {
  Stage stage{open_ground({block(4, 24, -30, 30, 40)})};

  Frame draw(const Camera& camera, std::vector<PersonInstance> people = {}) {
    Scene scene;
    scene.people = std::move(people);
    Lens lens(stage.renderer(), stage.people());
    return lens.draw(scene, camera);
  }
};

/// The first surface that a ray meets: the block or the ground.
struct Hit {
  std::uint32_t id = kIdNothing;
  double depth_m = std::numeric_limits<double>::infinity();
};

Hit find_hit(const Camera& camera, const Vector2d& pixel) {
  const Vector3d from = camera.pose.center();
  const Vector3d ray = camera.unproject(pixel, 1) - from;
  Hit hit;
  if (ray.z() < 0) hit = {kIdGround, -from.z() / ray.z()};
  double enter = 0;
  double leave = hit.depth_m;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (kWall.min()[axis] - from[axis]) / ray[axis];
    const double b = (kWall.max()[axis] - from[axis]) / ray[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter < leave) hit = {kIdBuilding, enter};
  return hit;
}

struct Errors {
  std::size_t compared = 0;
  std::size_t other_surface = 0;
  std::size_t sky = 0;  ///< where a surface is
  double worst = 0;     ///< relative, of the depth
};

/// Pixels closer than this to where surfaces meet, or to the end of the lens, show either.
constexpr double kEdgePx = 2;

Errors count_errors(const Frame& frame) {
  Errors errors;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (!frame.camera.intrinsics.direction_of({x, y})) continue;
      const Hit hit = find_hit(frame.camera, {x, y});
      bool at_edge = false;
      for (const Vector2d& off : {Vector2d(kEdgePx, 0), Vector2d(-kEdgePx, 0), Vector2d(0, kEdgePx),
                                  Vector2d(0, -kEdgePx)}) {
        const Vector2d beside = Vector2d(x, y) + off;
        at_edge = at_edge || !frame.camera.intrinsics.direction_of(beside) ||
                  find_hit(frame.camera, beside).id != hit.id;
      }
      if (at_edge) continue;
      ++errors.compared;
      const std::size_t pixel = pixel_index(frame, x, y);
      const double depth_m = static_cast<double>(frame.depth_m[pixel]);
      if (frame.id[pixel] != hit.id) ++errors.other_surface;
      if (hit.id != kIdNothing && std::isinf(depth_m)) ++errors.sky;
      if (hit.id == kIdNothing || !(hit.depth_m < 100)) continue;
      errors.worst = std::max(errors.worst, std::abs(depth_m / hit.depth_m - 1));
    }
  }
  return errors;
}

struct NamedLens {
  const char* name;
  double focal_px;  ///< of an image of 160 x 120
  std::optional<Distortion> distortion;
};

std::vector<NamedLens> lenses() {
  return {{"pinhole", 139, std::nullopt},
          {"wide pinhole", 60, std::nullopt},
          {"equidistant", 60, Distortion(Model::fisheye, {})},
          {"fisheye", 57, Distortion(Model::fisheye, {-0.02, 0.01, 0, 0})},
          {"barrel", 125, Distortion(Model::brown_conrady, {-0.25, 0.06, 0.001, 0.002})}};
}

TEST_F(NearSurfaces, GroundAndWallAreThereFromAFewCentimeters) {
  struct Pose {
    Vector3d center;
    double yaw_deg;
    double pitch_deg;
  };
  const std::vector<Pose> poses = {
      {{0, 0, 0.02}, 90, -90},          {{0, 0, 0.03}, 20, -45},   {{0, 0, 0.05}, 200, 0},
      {{0, 0, 0.08}, 70, -15},          {{0, 0, 0.015}, 130, -70}, {{-1.2, 3.1, 0.02}, 180, 20},
      {{3.98, 0, 0.4}, 0, 0},           {{3.97, 2, 1.5}, 40, -10}, {{3.95, -3, 8}, 90, 0},
      {{3.98, 1, 0.02}, 10, -35},       {{3.99, 1, 5}, -85, -60},  {{3.96, 0.3, 0.04}, 88, -5},
      {{-39.97, 39.96, 0.03}, 45, -20}, {{-55, 70, 0.04}, 45, -20}};
  for (const NamedLens& lens : lenses()) {
    for (const Pose& pose : poses) {
      Camera camera = camera_at(pose.center, pose.yaw_deg, pose.pitch_deg, 160, 120);
      camera.intrinsics.fx_px = lens.focal_px;
      camera.intrinsics.fy_px = lens.focal_px;
      camera.intrinsics.distortion = lens.distortion;
      const Errors errors = count_errors(draw(camera));
      SCOPED_TRACE(std::string(lens.name) + " at " + std::to_string(pose.center.x()) + ", " +
                   std::to_string(pose.center.y()) + ", " + std::to_string(pose.center.z()) + " " +
                   std::to_string(pose.yaw_deg) + " " + std::to_string(pose.pitch_deg));
      EXPECT_GT(errors.compared, 12'000U);
      EXPECT_EQ(errors.sky, 0U);
      EXPECT_EQ(errors.other_surface, 0U);
      EXPECT_LT(errors.worst, 1e-2);  // of ground that goes on for kilometers
    }
  }
}

// Somebody against whom a drone lies hides the ground and the wall.
TEST_F(NearSurfaces, SomebodyIsThereFromAFewCentimeters) {
  const PersonInstance person = stage.standing(7, 0, 0);
  const Frame from_afar = draw(camera_at({-3, 0, 1}, 0, 0), {person});
  const double front_m =
      static_cast<double>(from_afar.depth_m[pixel_index(from_afar, 160, 120)]) - 3;
  for (const double gap_m : {0.01, 0.03, 0.07}) {
    const Frame near = draw(camera_at({front_m - gap_m, 0, 1}, 0, 0), {person});
    SCOPED_TRACE(gap_m);
    EXPECT_EQ(near.id[pixel_index(near, 160, 120)], id_of_agent(7));
    EXPECT_NEAR(near.depth_m[pixel_index(near, 160, 120)], gap_m, 0.002);
  }
}

}  // namespace
}  // namespace throng::render
