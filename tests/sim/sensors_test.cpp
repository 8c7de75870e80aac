// The sensors' errors have the documented sizes and durations.
#include "sim/sensors/sensors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/geometry/angle.h"

namespace throng::sim {
namespace {

using Eigen::Vector3d;

constexpr double kStepS = 1.0 / 60;
constexpr double kLatitude = 45 * kDegree;

std::vector<world::DroneSample> hover(double duration_s) {
  std::vector<world::DroneSample> samples;
  for (int i = 0; i * kStepS <= duration_s; ++i) {
    world::DroneSample sample;
    sample.time_s = i * kStepS;
    sample.position = {3, 4, 20};
    sample.specific_force = {0, 0, 9.81};
    samples.push_back(sample);
  }
  return samples;
}

struct Moments {
  double mean;
  double sd;
};

template <typename Value>
Moments compute_moments(const SensorLog& log, const Value& value) {
  double sum = 0;
  double squares = 0;
  for (const SensorReading& reading : log.readings()) {
    sum += value(reading);
    squares += value(reading) * value(reading);
  }
  const auto n = static_cast<double>(log.readings().size());
  return {sum / n, std::sqrt(squares / n - sum / n * sum / n)};
}

SensorNoise quiet_but_for(const std::function<void(SensorNoise&)>& change) {
  SensorNoise noise;
  noise.gyro = noise.accelerometer = {Vector3d::Zero(), 0, 1000, 0};
  noise.gps_white_m = 0;
  noise.gps_wander_m.setZero();
  noise.gps_velocity_mps.setZero();
  noise.pressure_pa = noise.weather_share = noise.field_share = 0;
  change(noise);
  return noise;
}

SensorLog record_log(double duration_s, const SensorNoise& noise, std::uint64_t seed = 3) {
  return {hover(duration_s), seed, 0, kLatitude, noise};
}

TEST(Sensors, WithoutNoiseTellTheTruth) {
  auto truth = hover(10);
  for (world::DroneSample& sample : truth) {
    sample.orientation = Eigen::AngleAxisd(90 * kDegree, Vector3d::UnitZ());
    sample.velocity = {1, 2, 3};
    sample.body_rates = {0.1, 0.2, 0.3};
  }
  const SensorLog log(truth, 1, 0, kLatitude, quiet_but_for([](SensorNoise&) {}));
  const SensorReading& reading = log.at(5);
  EXPECT_TRUE(reading.gyro.isApprox(Vector3d(0.1, 0.2, 0.3), 1e-12));
  EXPECT_TRUE(reading.accelerometer.isApprox(Vector3d(0, 0, 9.81), 1e-12));
  EXPECT_NEAR(reading.height_m, 20, 1e-6);
  EXPECT_TRUE(reading.gps.position.isApprox(Vector3d(3, 4, 20), 1e-12));
  EXPECT_TRUE(reading.gps.velocity.isApprox(Vector3d(1, 2, 3), 1e-12));
  // Looking north, the field is ahead and below.
  const Vector3d& field = reading.magnetometer;
  EXPECT_NEAR(field.x(), 30 * std::cos(kLatitude), 1e-9);
  EXPECT_NEAR(field.y(), 0, 1e-9);
  EXPECT_NEAR(std::atan2(-field.z(), field.x()), std::atan(2 * std::tan(kLatitude)), 1e-9);
}

TEST(Sensors, WhiteNoiseHasItsDensity) {
  const SensorNoise noise = quiet_but_for([](SensorNoise& n) {
    n.gyro.density.setConstant(3.394e-4);
    n.accelerometer.density.setConstant(4e-3);
  });
  const SensorLog log = record_log(600, noise);
  for (int axis = 0; axis < 3; ++axis) {
    const Moments gyro = compute_moments(log, [&](const SensorReading& r) { return r.gyro[axis]; });
    EXPECT_NEAR(gyro.sd, 3.394e-4 * std::sqrt(60), 0.02 * gyro.sd);
    EXPECT_NEAR(gyro.mean, 0, 4 * gyro.sd / std::sqrt(36'000));
    const Moments force =
        compute_moments(log, [&](const SensorReading& r) { return r.accelerometer[axis]; });
    EXPECT_NEAR(force.sd, 4e-3 * std::sqrt(60), 0.02 * force.sd);
  }
}

// Standard deviation of neighboring means over `n` readings, by Allan (1966): of white noise it
// falls with the root of the time, of a wandering bias it rises.
double allan_deviation(const SensorLog& log, std::size_t n) {
  std::vector<double> means;
  for (std::size_t i = 0; i + n <= log.readings().size(); i += n) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += log.readings()[i + j].gyro.x();
    means.push_back(sum / static_cast<double>(n));
  }
  double squares = 0;
  for (std::size_t i = 1; i < means.size(); ++i) {
    squares += (means[i] - means[i - 1]) * (means[i] - means[i - 1]);
  }
  return std::sqrt(0.5 * squares / static_cast<double>(means.size() - 1));
}

TEST(Sensors, AllanDeviationFallsWithNoiseAndRisesWithTheBias) {
  const SensorNoise white = quiet_but_for([](SensorNoise& n) { n.gyro.density.setConstant(1e-3); });
  const SensorLog noisy = record_log(4000, white);
  for (const std::size_t n : {60U, 240U, 960U}) {  // 1, 4 and 16 s
    const double expected = 1e-3 / std::sqrt(static_cast<double>(n) * kStepS);
    EXPECT_NEAR(allan_deviation(noisy, n), expected, 0.15 * expected) << n;
  }
  // Far below its correlation time a bias walks at random: K sqrt(t / 3).
  const SensorNoise walk = quiet_but_for([](SensorNoise& n) { n.gyro.walk = 1e-3; });
  const SensorLog wandering = record_log(4000, walk);
  for (const std::size_t n : {60U, 240U, 960U}) {
    const double expected = 1e-3 * std::sqrt(static_cast<double>(n) * kStepS / 3);
    EXPECT_NEAR(allan_deviation(wandering, n), expected, 0.15 * expected) << n;
  }
}

TEST(Sensors, BiasesWanderWithTheirStandardDeviation) {
  // sd = walk sqrt(correlation / 2), over many runs long after the start.
  const SensorNoise noise = quiet_but_for([](SensorNoise& n) {
    n.gyro.walk = 1e-3;
    n.gyro.walk_s = 2;
  });
  const SensorLog log = record_log(4000, noise);
  const Moments bias = compute_moments(log, [](const SensorReading& r) { return r.gyro.y(); });
  EXPECT_NEAR(bias.sd, 1e-3, 0.05e-3);
}

TEST(Sensors, TurnOnBiasesDifferFromRunToRun) {
  const SensorNoise noise = quiet_but_for([](SensorNoise& n) { n.accelerometer.turn_on = 0.196; });
  double squares = 0;
  constexpr int kRuns = 400;
  for (int seed = 0; seed < kRuns; ++seed) {
    const SensorLog log = record_log(0.1, noise, static_cast<std::uint64_t>(seed));
    const double bias = log.readings().front().accelerometer.x();
    EXPECT_EQ(bias, log.readings().back().accelerometer.x());
    squares += bias * bias;
  }
  EXPECT_NEAR(std::sqrt(squares / kRuns), 0.196, 0.02);
}

TEST(Sensors, GpsIsLateAndSeldomAndWanders) {
  SensorNoise noise = quiet_but_for([](SensorNoise& n) {
    n.gps_wander_m = {1, 2};
    n.gps_wander_s = 10;
  });
  const SensorLog log = record_log(6000, noise);
  double last_s = -1;
  int fixes = 0;
  for (const SensorReading& reading : log.readings()) {
    if (reading.time_s > 1) {
      EXPECT_GE(reading.time_s - reading.gps.time_s, 0.12 - 1e-9);
      EXPECT_LT(reading.time_s - reading.gps.time_s, 0.12 + 0.2 + 2 * kStepS);
    }
    fixes += reading.gps.time_s != last_s ? 1 : 0;
    last_s = reading.gps.time_s;
  }
  EXPECT_NEAR(fixes, 30'000, 2);
  const auto east = [](const SensorReading& r) { return r.gps.position.x() - 3; };
  EXPECT_NEAR(compute_moments(log, east).sd, 1, 0.08);
  const auto up = [](const SensorReading& r) { return r.gps.position.z() - 20; };
  EXPECT_NEAR(compute_moments(log, up).sd, 2, 0.16);
  // Correlated as exp(-t / 10 s).
  double own = 0;
  double lagged = 0;
  constexpr std::size_t kLag = 600;
  for (std::size_t i = 0; i + kLag < log.readings().size(); ++i) {
    own += east(log.readings()[i]) * east(log.readings()[i]);
    lagged += east(log.readings()[i]) * east(log.readings()[i + kLag]);
  }
  EXPECT_NEAR(lagged / own, std::exp(-1), 0.1);
}

TEST(Sensors, BarometerAndMagnetometerHaveTheirNoise) {
  const SensorNoise noise = quiet_but_for([](SensorNoise& n) {
    n.pressure_pa = 1;
    n.field_share = 0.013;
  });
  const SensorLog log = record_log(600, noise);
  const Moments pressure =
      compute_moments(log, [](const SensorReading& r) { return r.pressure_pa; });
  EXPECT_NEAR(pressure.sd, 1, 0.02);
  EXPECT_NEAR(pressure.mean, pressure_at(20), 0.05);
  const Moments height = compute_moments(log, [](const SensorReading& r) { return r.height_m; });
  EXPECT_NEAR(height.sd, 0.083, 0.003);
  const Moments field =
      compute_moments(log, [](const SensorReading& r) { return r.magnetometer.y(); });
  EXPECT_NEAR(field.sd, 0.013 * magnetic_field(kLatitude).norm(), 0.02 * field.sd);
}

TEST(Sensors, PressureIsThatOfTheStandardAtmosphere) {
  EXPECT_NEAR(pressure_at(0), 101'325, 1e-6);
  EXPECT_NEAR(pressure_at(1000), 89'875, 5);
  EXPECT_NEAR(height_at(pressure_at(123.4)), 123.4, 1e-6);
}

TEST(Sensors, SameSeedSameReadings) {
  const SensorLog one = record_log(20, {}, 5);
  const SensorLog two = record_log(20, {}, 5);
  const SensorLog other_run = record_log(20, {}, 6);
  const SensorLog other_drone(hover(20), 5, 1, kLatitude);
  EXPECT_EQ(one.at(13).gyro, two.at(13).gyro);
  EXPECT_NE(one.at(13).gyro, other_run.at(13).gyro);
  EXPECT_NE(one.at(13).gyro, other_drone.at(13).gyro);
  EXPECT_EQ(one.at(-1).time_s, 0);
  EXPECT_NEAR(one.at(13.01).time_s, 13, 1e-9);
}

}  // namespace
}  // namespace throng::sim
