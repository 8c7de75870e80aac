#include "sim/vehicle/wind.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace throng::sim {
namespace {

using Eigen::Vector3d;

constexpr double kGridS = 1.0 / 60;

WindSpec breeze(double speed_mps) {
  WindSpec wind;
  wind.speed_mps = speed_mps;
  return wind;
}

std::vector<Vector3d> sample_gusts(const WindSpec& spec, double height_m, double airspeed_mps,
                                   double duration_s, std::uint64_t seed = 3) {
  Gusts gusts(spec, seed, 0);
  std::vector<Vector3d> list;
  for (int i = 0; i * kGridS < duration_s; ++i) {
    list.push_back(gusts.at(i * kGridS, height_m, airspeed_mps));
  }
  return list;
}

Vector3d standard_deviations(const std::vector<Vector3d>& values) {
  Vector3d sum = Vector3d::Zero();
  Vector3d squares = Vector3d::Zero();
  for (const Vector3d& v : values) {
    sum += v;
    squares += v.cwiseProduct(v);
  }
  const auto n = static_cast<double>(values.size());
  return (squares / n - (sum / n).cwiseProduct(sum / n)).cwiseSqrt();
}

double correlation(const std::vector<Vector3d>& values, int axis, int lag) {
  double own = 0;
  double lagged = 0;
  for (std::size_t i = 0; i + lag < values.size(); ++i) {
    own += values[i][axis] * values[i][axis];
    lagged += values[i][axis] * values[i + lag][axis];
  }
  return lagged / own;
}

TEST(Wind, BlowsAsAskedAtTenMeters) {
  for (const WindProfile profile :
       {WindProfile::uniform, WindProfile::log_law, WindProfile::power_law}) {
    WindSpec wind = breeze(6);
    wind.profile = profile;
    wind.direction_rad = EIGEN_PI / 2;
    EXPECT_TRUE(wind.mean_at(10).isApprox(Vector3d(0, 6, 0), 1e-9));
  }
}

TEST(Wind, GrowsWithHeightAsItsLawSays) {
  WindSpec wind = breeze(6);
  wind.roughness_m = 0.1;
  EXPECT_NEAR(wind.mean_at(100).x(), 6 * 1.5, 1e-9);  // ln 1000 / ln 100
  EXPECT_EQ(wind.mean_at(0.05).norm(), 0);
  wind.profile = WindProfile::power_law;
  wind.exponent = 0.5;
  EXPECT_NEAR(wind.mean_at(40).x(), 12, 1e-9);
  EXPECT_EQ(wind.mean_at(-1).norm(), 0);
  wind.profile = WindProfile::uniform;
  EXPECT_EQ(wind.mean_at(200).x(), 6);
}

TEST(Gusts, OfDrydenHaveTheStandardsStrengthAndSize) {
  // At 100 ft in 10 m/s at 20 ft: sigma_w = 1 m/s, sigma_u = 1 / 0.2593^0.4, L_w = 100 ft, L_u =
  // 100 ft / 0.2593^1.2.
  WindSpec wind = breeze(10);
  wind.profile = WindProfile::uniform;
  const double height_m = 30.48;
  const double airspeed_mps = 12;
  const auto gusts = sample_gusts(wind, height_m, airspeed_mps, 40'000);
  const Vector3d sd = standard_deviations(gusts);
  EXPECT_NEAR(sd.z(), 1.0, 0.03);
  EXPECT_NEAR(sd.x(), 1 / std::pow(0.2593, 0.4), 0.06);
  EXPECT_NEAR(sd.y(), sd.x(), 0.08);
  // Along the wind the correlation falls as exp(-lag V / L).
  const double length_m = height_m / std::pow(0.2593, 1.2);
  const int lag = 120;
  EXPECT_NEAR(correlation(gusts, 0, lag), std::exp(-lag * kGridS * airspeed_mps / length_m), 0.03);
  // Across it as exp(-x) (1 - x / 2).
  const double x = lag * kGridS * airspeed_mps / length_m;
  EXPECT_NEAR(correlation(gusts, 1, lag), std::exp(-x) * (1 - 0.5 * x), 0.04);
}

TEST(Gusts, OfOrnsteinAndUhlenbeckHaveTheirStrengthAndDuration) {
  WindSpec wind;
  wind.gusts = GustModel::ou;
  wind.gust_mps = 1.5;
  wind.gust_time_s = 3;
  const auto gusts = sample_gusts(wind, 20, 5, 30'000);
  const Vector3d sd = standard_deviations(gusts);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sd[axis], 1.5, 0.05);
    EXPECT_NEAR(correlation(gusts, axis, 180), std::exp(-1), 0.04);
  }
}

TEST(Gusts, TurnWithTheWind) {
  WindSpec east = breeze(8);
  WindSpec north = east;
  north.direction_rad = EIGEN_PI / 2;
  const auto one = sample_gusts(east, 20, 8, 10);
  const auto two = sample_gusts(north, 20, 8, 10);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(two[i].y(), one[i].x(), 1e-12);
    EXPECT_NEAR(two[i].x(), -one[i].y(), 1e-12);
    EXPECT_EQ(two[i].z(), one[i].z());
  }
}

TEST(Gusts, DependOnSeedAndCraftButNotOnHowOftenTheyAreAskedFor) {
  const WindSpec wind = breeze(8);
  Gusts often(wind, 5, 0);
  Gusts seldom(wind, 5, 0);
  Gusts other_seed(wind, 6, 0);
  Gusts other_vehicle(wind, 5, 1);
  Vector3d last = Vector3d::Zero();
  for (int i = 0; i <= 4000; ++i) last = often.at(i / 400.0, 20, 8);
  for (int i = 0; i < 7; ++i) seldom.at(i * 1.5, 20, 8);
  EXPECT_TRUE(last.isApprox(seldom.at(10, 20, 8), 1e-12));
  EXPECT_FALSE(last.isApprox(other_seed.at(10, 20, 8), 1e-3));
  EXPECT_FALSE(last.isApprox(other_vehicle.at(10, 20, 8), 1e-3));
}

TEST(Gusts, NoneInStillAirAndWhereNoneAreWanted) {
  for (const Vector3d& gust : sample_gusts(breeze(0), 20, 0, 5)) EXPECT_EQ(gust.norm(), 0);
  WindSpec smooth = breeze(9);
  smooth.gusts = GustModel::none;
  for (const Vector3d& gust : sample_gusts(smooth, 20, 9, 5)) EXPECT_EQ(gust.norm(), 0);
}

}  // namespace
}  // namespace throng::sim
