// The solver's camera is the renderer's.
#include "calibrate/projection.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace throng::calibrate {
namespace {

TEST(Projection, IsThatOfTheCamerasThatRender) {
  for (const Lens lens : kLenses) {
    Parameters p{800, 790, 321, 243, 1.5};
    const Parameters values{0, 0, 0, 0, 0, -0.2, 0.05, 0.001, -0.002, -0.01, 0.02, 0.01, 0.003};
    for (std::size_t i = kCoefficients; i < kParameters; ++i) {
      if (!parameter_name(lens, i).empty()) p[i] = 0.5 * values[i];
    }
    const camera::Intrinsics k = intrinsics_of(lens, p, 640, 480);
    EXPECT_EQ(parameters_of(k), p);
    for (double x = -0.45; x < 0.5; x += 0.15) {
      for (double y = -0.3; y < 0.35; y += 0.15) {
        const Eigen::Vector3d point(2 * x, 2 * y, 2);
        Eigen::Vector2d pixel;
        ASSERT_TRUE(project(lens == Lens::fisheye, p.data(), point.data(), pixel.data()));
        const auto wanted = k.pixel_of({x, y});
        ASSERT_TRUE(wanted.has_value());
        EXPECT_LT((pixel - *wanted).norm(), 1e-9) << name_of(lens) << ' ' << x << ' ' << y;
        const auto back = k.direction_of(pixel);
        ASSERT_TRUE(back.has_value());
        EXPECT_LT((*back - Eigen::Vector2d(x, y)).norm(), 1e-9);
      }
    }
  }
}

TEST(Projection, ShowsNothingBehindTheCamera) {
  const Parameters p{800, 800, 320, 240};
  const Eigen::Vector3d behind(0.1, 0.1, -1);
  Eigen::Vector2d pixel;
  EXPECT_FALSE(project(false, p.data(), behind.data(), pixel.data()));
}

TEST(Rules, RefuseWhatContradictsItself) {
  Wishes wishes;
  wishes.fixed["k9"] = 0;
  EXPECT_THROW(rules_of(Lens::brown5, wishes, "--fix"), InputError);
  wishes = {};
  wishes.fixed["k3"] = 0;
  EXPECT_THROW(rules_of(Lens::brown4, wishes, "--fix"), InputError);
  wishes.priors["k3"] = {0, 0.1};
  EXPECT_THROW(rules_of(Lens::brown5, wishes, "--fix"), InputError);
  wishes = {};
  wishes.tied["fx"] = {"fy", 1};
  wishes.tied["fy"] = {"fx", 1};
  EXPECT_THROW(rules_of(Lens::brown5, wishes, "--tie"), InputError);
  wishes = {};
  wishes.fixed["fx"] = std::nullopt;
  EXPECT_THROW(rules_of(Lens::brown5, wishes, "--fix"), InputError);
}

}  // namespace
}  // namespace throng::calibrate
