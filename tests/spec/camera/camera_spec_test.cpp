#include "spec/camera/camera_spec.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/geometry/angle.h"

namespace throng::camera {
namespace {

TEST(CameraSpec, FieldOfViewIsThatOfTheImage) {
  CameraSpec spec;
  spec.width = 800;
  spec.hfov_deg = 60;
  const auto k = spec.intrinsics();
  ASSERT_TRUE(k.has_value());
  EXPECT_NEAR(2 * std::atan(400 / k->fx_px), 60 * kDegree, 1e-12);
  EXPECT_EQ(k->cx_px, 399.5);
  EXPECT_FALSE(k->distortion.has_value());
  EXPECT_NEAR(spec.pinhole_hfov_rad(), 60 * kDegree, 1e-12);
  spec.fx_px = 400;
  EXPECT_EQ(spec.intrinsics()->fy_px, 400);
  EXPECT_NEAR(spec.pinhole_hfov_rad(), 90 * kDegree, 1e-12) << "the focal length counts";
}

TEST(CameraSpec, ALensShowsHalfTheAngleAtTheEdge) {
  for (const LensModel model : {LensModel::brown_conrady, LensModel::fisheye}) {
    CameraSpec spec;
    spec.hfov_deg = 90;
    spec.lens.model = model;
    spec.lens.k1 = -0.05;
    const auto k = spec.intrinsics();
    ASSERT_TRUE(k.has_value());
    const auto edge = k->direction_of({k->cx_px + 0.5 * spec.width, k->cy_px});
    ASSERT_TRUE(edge.has_value());
    EXPECT_NEAR(edge->x(), 1, 1e-9);
  }
}

TEST(CameraSpec, ALensThatFoldsBeforeTheEdgeHasNoFocalLength) {
  CameraSpec spec;
  spec.hfov_deg = 120;
  spec.lens.model = LensModel::brown_conrady;
  spec.lens.k1 = -0.5;
  EXPECT_FALSE(spec.intrinsics().has_value());
  spec.fx_px = 500;
  EXPECT_TRUE(spec.intrinsics().has_value()) << "then it may show less";
}

TEST(CameraSpec, CoefficientsAreInTheModelsOrder) {
  LensSpec lens{LensModel::brown_conrady, 1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(lens.distortion()->coefficients(), (Distortion::Coefficients{1, 2, 7, 8, 3, 4, 5, 6}));
  lens.model = LensModel::fisheye;
  EXPECT_EQ(lens.distortion()->coefficients(), (Distortion::Coefficients{1, 2, 3, 4, 0, 0, 0, 0}));
  lens.model = LensModel::pinhole;
  EXPECT_FALSE(lens.distortion().has_value());
}

TEST(CameraSpec, ARealCameraCounts) {
  CameraSpec spec;
  spec.hfov_deg = 30;
  spec.calibrated = intrinsics_from_hfov(640, 480, 70 * kDegree);
  EXPECT_EQ(spec.intrinsics()->width, 640);
  EXPECT_EQ(spec.intrinsics()->fx_px, spec.calibrated->fx_px);
}

}  // namespace
}  // namespace throng::camera
