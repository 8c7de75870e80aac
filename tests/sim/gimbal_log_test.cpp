#include "sim/sensors/gimbal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "base/geometry/angle.h"

namespace throng::sim {
namespace {

constexpr double kSampleS = 1.0 / 60;

std::vector<world::DroneSample> turning(double duration_s,
                                        const std::function<double(double)>& yaw_rad) {
  std::vector<world::DroneSample> samples;
  for (int i = 0; i * kSampleS <= duration_s; ++i) {
    world::DroneSample sample;
    sample.time_s = i * kSampleS;
    sample.orientation = Eigen::AngleAxisd(yaw_rad(sample.time_s), Eigen::Vector3d::UnitZ());
    samples.push_back(sample);
  }
  return samples;
}

camera::CameraSpec camera_at(double yaw_rad, double pitch_rad, const camera::GimbalSpec& gimbal) {
  camera::CameraSpec camera;
  camera.yaw_deg = yaw_rad / kDegree;
  camera.pitch_deg = pitch_rad / kDegree;
  camera.gimbal = gimbal;
  return camera;
}

camera::GimbalSpec still() {
  camera::GimbalSpec spec;
  spec.model = camera::GimbalModel::second_order;
  spec.jitter_rad = spec.bias_rad = spec.reading_rad = 0;
  return spec;
}

TEST(GimbalLog, AnswersAStepAsASecondOrderSystem) {
  // w = 25 rad/s, z = 0.7: overshoot exp(-pi z / sqrt(1 - z²)) = 4.6 % after pi / (w sqrt(1 - z²)).
  const double size = 40 * kDegree;
  const GimbalLog log(turning(3, [&](double t) { return t > 1 - 1e-9 ? size : 0; }),
                      camera_at(0, -0.5, still()), 1, 0);
  double max_yaw_rad = 0;
  double max_s = 0;
  for (double t = 1; t < 3; t += 0.001) {
    if (log.view_at(t).yaw <= max_yaw_rad) continue;
    max_yaw_rad = log.view_at(t).yaw;
    max_s = t;
  }
  EXPECT_NEAR(max_yaw_rad / size, 1.046, 0.01);
  EXPECT_NEAR(max_s - 1, EIGEN_PI / (25 * std::sqrt(1 - 0.49)), 0.02);
  EXPECT_NEAR(log.view_at(3).yaw, size, 1e-6);
  EXPECT_NEAR(log.view_at(2.5).pitch, -0.5, 1e-9);
  EXPECT_NEAR(log.view_at(2.5).roll, 0, 1e-9);
}

TEST(GimbalLog, ADroneThatTurnsRoundAndRoundIsFollowedWithoutJumps) {
  const GimbalLog log(turning(20, [](double t) { return t; }), camera_at(0.3, 0, still()), 1, 0);
  // A ramp is followed 2 z / w behind.
  const double behind = 2 * 0.7 / 25;
  for (double t = 1; t < 20; t += 0.37) {
    EXPECT_NEAR(log.view_at(t).yaw, t + 0.3 - behind, 1e-2) << t;
  }
}

TEST(GimbalLog, ShakesAndIsMisalignedAsMuchAsItSays) {
  camera::GimbalSpec spec;
  spec.model = camera::GimbalModel::second_order;
  const auto truth = turning(300, [](double) { return 0.0; });
  double biases = 0;
  constexpr int kCameras = 60;
  for (int camera = 0; camera < kCameras; ++camera) {
    const auto number = static_cast<std::uint64_t>(camera);
    const GimbalLog log(camera == 0 ? truth : turning(2, [](double) { return 0.0; }),
                        camera_at(0, -1, spec), 7, number);
    double sum = 0;
    double squares = 0;
    double errors = 0;
    int n = 0;
    const double end_s = camera == 0 ? 300 : 2;
    for (double t = 0; t < end_s; t += kSampleS, ++n) {
      const double off = log.view_at(t).pitch + 1;
      sum += off;
      squares += off * off;
      const double error = log.reading_at(t).pitch - log.view_at(t).pitch;
      errors += error;
    }
    const double bias = sum / n;
    EXPECT_LT(std::abs(bias), spec.bias_rad + spec.jitter_rad);
    EXPECT_NEAR(errors / n, -bias, 0.25 * spec.bias_rad) << "it does not know its bias";
    biases += bias * bias;
    if (camera > 0) continue;
    EXPECT_NEAR(std::sqrt(squares / n - bias * bias), spec.jitter_rad, 0.1 * spec.jitter_rad);
  }
  // Uniform: the standard deviation is a root of a third of the limit.
  EXPECT_NEAR(std::sqrt(biases / kCameras), spec.bias_rad / std::sqrt(3), 0.25 * spec.bias_rad);
}

TEST(GimbalLog, FollowsTheSetPointsOfAPilot) {
  // From the camera's own 0 degrees down to -40 between 1 and 2 s, then held.
  const std::vector<PilotSample> setpoints = {
      {0, {}, 0, true}, {1, {}, 0, true}, {2, {}, 0, true, {{-40, 20}}}};
  const auto truth = turning(4, [](double) { return 0.0; });
  const GimbalLog ideal(truth, camera_at(0, 0, {}), 1, 0, setpoints);
  EXPECT_NEAR(ideal.view_at(0.5).pitch, 0, 1e-12);
  EXPECT_NEAR(ideal.view_at(1.5).pitch, -20 * kDegree, 1e-9);
  EXPECT_NEAR(ideal.view_at(1.5).yaw, 10 * kDegree, 1e-9);
  EXPECT_NEAR(ideal.view_at(3).pitch, -40 * kDegree, 1e-9);
  const GimbalLog real(truth, camera_at(0, 0, still()), 1, 0, setpoints);
  // A ramp is followed 2 z / w behind.
  EXPECT_NEAR(real.view_at(1.8).pitch, -40 * kDegree * (0.8 - 2 * 0.7 / 25), 1e-2);
  EXPECT_NEAR(real.view_at(4).pitch, -40 * kDegree, 1e-6);
}

TEST(GimbalLog, AnIdealOneLooksWhereItIsTold) {
  const GimbalLog log(turning(2, [](double t) { return 0.2 * t; }), camera_at(0.1, -0.4, {}), 3, 0);
  EXPECT_NEAR(log.view_at(1.234).yaw, 0.2 * 1.234 + 0.1, 1e-9);
  EXPECT_DOUBLE_EQ(log.view_at(1.234).pitch, -0.4);
  EXPECT_DOUBLE_EQ(log.reading_at(1).pitch, -0.4);
}

}  // namespace
}  // namespace throng::sim
