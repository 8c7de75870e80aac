#include "camera/distortion.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <string>

#include "camera/camera.h"

namespace throng::camera {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Model = Distortion::Model;

struct Lens {
  const char* name;
  Distortion distortion;
};

void PrintTo(const Lens& lens, std::ostream* stream) { *stream << lens.name; }

class EveryLens : public ::testing::TestWithParam<Lens> {};

TEST_P(EveryLens, UndistortUndoesDistort) {
  const Distortion& lens = GetParam().distortion;
  const double reach = 0.98 * std::min(lens.limit(), 2.0);
  for (int i = 0; i <= 20; ++i) {
    for (int direction = 0; direction < 12; ++direction) {
      const double angle = direction * std::numbers::pi / 6;
      const Vector2d pinhole = reach * i / 20 * Vector2d(std::cos(angle), std::sin(angle));
      const auto shown = lens.distort(pinhole);
      ASSERT_TRUE(shown);
      const auto back = lens.undistort(*shown);
      // Tangential terms may fold the image a little before the radial ones do.
      if (!(lens.derivatives(pinhole).determinant() > 0.05)) continue;
      ASSERT_TRUE(back) << pinhole.transpose();
      EXPECT_LT((*back - pinhole).norm(), 1e-9) << pinhole.transpose();
    }
  }
}

TEST_P(EveryLens, AGuessChangesNothing) {
  const Distortion& lens = GetParam().distortion;
  for (const Vector2d& shown : {Vector2d(0, 0), Vector2d(0.3, -0.2), Vector2d(-0.1, 0.5)}) {
    const auto alone = lens.undistort(shown);
    for (const Vector2d& guess : {shown, Vector2d(0.31, -0.2), Vector2d(-3, 2), Vector2d(90, 0)}) {
      const auto guessed = lens.undistort(shown, guess);
      ASSERT_EQ(alone.has_value(), guessed.has_value());
      if (!alone) continue;
      EXPECT_LT((*alone - *guessed).norm(), 1e-10) << guess.transpose();
    }
  }
}

TEST_P(EveryLens, DerivativesAreThoseOfDistort) {
  const Distortion& lens = GetParam().distortion;
  constexpr double kStep = 1e-6;
  for (const Vector2d& p : {Vector2d(0, 0), Vector2d(0.3, -0.2), Vector2d(-0.1, 0.5)}) {
    const Eigen::Matrix2d j = lens.derivatives(p);
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2d step = kStep * Vector2d::Unit(axis);
      const Vector2d slope = (*lens.distort(p + step) - *lens.distort(p - step)) / (2 * kStep);
      EXPECT_LT((j.col(axis) - slope).norm(), 1e-7);
    }
  }
}

TEST_P(EveryLens, IsMonotonicUpToItsLimit) {
  const Distortion& lens = GetParam().distortion;
  if (lens.coefficients()[2] != 0 && lens.model() == Model::brown_conrady) return;
  double before = 0;
  for (int i = 1; i <= 1000; ++i) {
    const double shown = lens.distort({lens.limit() * i / 1000, 0})->x();
    EXPECT_GT(shown, before);
    before = shown;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, EveryLens,
    ::testing::Values(
        Lens{"nothing", {Model::brown_conrady, {}}},
        Lens{"barrel", {Model::brown_conrady, {-0.28, 0.08, 0.001, -0.0005, -0.01}}},
        Lens{"pincushion", {Model::brown_conrady, {0.1, 0.02}}},
        Lens{"folding", {Model::brown_conrady, {-0.3}}},
        Lens{"rational", {Model::brown_conrady, {0.3, 0.05, 0.001, -0.0005, 0.01, 0.5, 0.1, 0.02}}},
        Lens{"equidistant", {Model::fisheye, {}}},
        Lens{"fisheye", {Model::fisheye, {-0.04, 0.003, -0.002, 0.0004}}}));

// The formulas worked out once more with other code.
TEST(Distortion, FollowsTheFormulas) {
  const Distortion barrel(Model::brown_conrady, {-0.28, 0.08, 0.001, -0.0005, -0.01});
  EXPECT_TRUE(
      barrel.distort({0.4, -0.3})->isApprox(Vector2d(0.37341250000000004, -0.279903125), 1e-13));
  const Distortion rational(Model::brown_conrady,
                            {0.3, 0.05, 0.001, -0.0005, 0.01, 0.5, 0.1, 0.02});
  EXPECT_TRUE(rational.distort({0.4, -0.3})
                  ->isApprox(Vector2d(0.38064042391604536, -0.28532406793703396), 1e-13));
  const Distortion fisheye(Model::fisheye, {-0.04, 0.003, -0.002, 0.0004});
  EXPECT_TRUE(fisheye.distort({0.8, -0.6})
                  ->isApprox(Vector2d(0.613274063564209, -0.45995554767315666), 1e-13));
}

TEST(Distortion, EndsWhereTheImageWouldFold) {
  // r (1 - 0.3 r^2) turns back where 1 - 0.9 r^2 = 0.
  const Distortion lens(Model::brown_conrady, {-0.3});
  const double limit = std::sqrt(1 / 0.9);
  EXPECT_NEAR(lens.limit(), limit, 1e-6);
  EXPECT_TRUE(lens.distort({0.99 * limit, 0}));
  EXPECT_FALSE(lens.distort({1.01 * limit, 0}));
  EXPECT_FALSE(lens.distort({std::nan(""), 0}));
  EXPECT_FALSE(lens.undistort({limit, 0})) << "farther out than anything is shown";
  EXPECT_NEAR(Distortion(Model::fisheye, {}).limit(), std::tan(80 * std::numbers::pi / 180), 1e-9);
}

TEST(Camera, ProjectsThroughItsLensAndBack) {
  Camera camera{intrinsics_from_hfov(640, 480, 1.4), pose_looking({1, 2, 20}, 0.4, -0.9)};
  camera.intrinsics.distortion.emplace(Model::brown_conrady,
                                       Distortion::Coefficients{-0.25, 0.05, 0.001, -0.001});
  for (const Vector2d& pixel : {Vector2d(0, 0), Vector2d(639.5, 479.5), Vector2d(320, 17.25)}) {
    const Vector3d world = camera.unproject(pixel, 15);
    const Camera::Projection seen = camera.project(world);
    EXPECT_TRUE(seen.visible);
    EXPECT_LT((seen.pixel - pixel).norm(), 1e-9);
    EXPECT_NEAR(seen.depth_m, 15, 1e-9);
  }
  Camera pinhole = camera;
  pinhole.intrinsics.distortion.reset();
  const Vector3d corner = camera.unproject({0, 0}, 15);
  EXPECT_LT(pinhole.project(corner).pixel.x(), -10) << "barrels pull the corners in";
}

TEST(Camera, PointsBeyondTheLensAreNotVisible) {
  Camera camera{intrinsics_from_hfov(640, 480, 1.4), pose_looking({0, 0, 0}, 0, 0)};
  EXPECT_TRUE(camera.project({1, 3, 0}).visible);
  EXPECT_FALSE(camera.project({-1, 0, 0}).visible) << "behind";
  camera.intrinsics.distortion.emplace(Model::brown_conrady, Distortion::Coefficients{-0.3});
  EXPECT_TRUE(camera.project({1, 0.5, 0}).visible);
  EXPECT_FALSE(camera.project({1, 3, 0}).visible);
  EXPECT_TRUE(camera.unproject({5000, 0}, 1).hasNaN());
}

}  // namespace
}  // namespace throng::camera
