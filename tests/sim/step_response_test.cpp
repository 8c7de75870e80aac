// Flight of an F450 (1.5 kg) against the bounds that a simulation of the same model met.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "base/geometry/angle.h"
#include "sim/vehicle/controller.h"
#include "sim/vehicle/flight_world.h"
#include "sim/vehicle/wind.h"
#include "spec/sim/airframe.h"
#include "tests/sim/airframes.h"

namespace throng::sim {
namespace {

using Eigen::Vector3d;
using testing::airframe_named;

const Vector3d kStart(0, 0, 30);

struct Rates {
  double physics_hz = 480;
  int physics_per_control = 2;
  int physics_per_delay = 0;
};

/// Those of hector_quadrotor, 100 decisions a second which take 0.01 s to the motors.
constexpr Rates kHectorRates{500, 5, 5};

struct Flown {
  std::vector<double> time_s;
  std::vector<Vector3d> position;
  double max_tilt_rad = 0;
  double max_speed_mps = 0;

  double position_along(std::size_t i, const Vector3d& axis) const {
    return (position[i] - kStart).dot(axis);
  }
  double first_beyond(double distance_m, const Vector3d& axis) const {
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      if (position_along(i, axis) >= distance_m) return time_s[i];
    }
    return INFINITY;
  }
  double furthest(const Vector3d& axis) const {
    double max_position_m = 0;
    for (std::size_t i = 0; i < time_s.size(); ++i)
      max_position_m = std::max(max_position_m, position_along(i, axis));
    return max_position_m;
  }
  double settled_within(double tolerance_m, const Vector3d& target) const {
    double last_outside_s = 0;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      if ((position[i] - target).norm() > tolerance_m) last_outside_s = time_s[i];
    }
    return last_outside_s;
  }
  double furthest_from(const Vector3d& point) const {
    double max_distance_m = 0;
    for (const Vector3d& p : position)
      max_distance_m = std::max(max_distance_m, (p - point).norm());
    return max_distance_m;
  }
};

// Flies from rest at kStart to `target`, in wind that rises at once.
Flown fly(const Airframe& frame, const Vector3d& target, double duration_s,
          const Vector3d& wind = Vector3d::Zero(), Rates rates = {}) {
  FlightWorld world({}, 1 / rates.physics_hz);
  world.add(frame, kStart, 0);
  world.set_air_velocity(0, wind);
  Controller controller(frame);
  Setpoint setpoint;
  setpoint.position = target;
  Flown flown;
  std::deque<PerRotor> commands;
  const int steps = static_cast<int>(std::lround(duration_s * rates.physics_hz));
  for (int step = 0; step < steps; ++step) {
    const FlightState state = world.state(0);
    if (step % rates.physics_per_control == 0) {
      const double control_dt_s = rates.physics_per_control / rates.physics_hz;
      commands.push_back(controller.update(state, setpoint, control_dt_s));
    }
    if (step % rates.physics_per_control == rates.physics_per_delay % rates.physics_per_control &&
        step >= rates.physics_per_delay) {
      world.command(0, commands.front());
      commands.pop_front();
    }
    world.step();
    flown.time_s.push_back((step + 1) / rates.physics_hz);
    flown.position.push_back(world.state(0).position);
    flown.max_tilt_rad =
        std::max(flown.max_tilt_rad, std::acos(std::min(1.0, world.state(0).rotation(2, 2))));
    flown.max_speed_mps = std::max(flown.max_speed_mps, world.state(0).velocity.norm());
  }
  return flown;
}

struct StepFigures {
  double rise_s;
  double t90_s;
  double overshoot;
  double settle_s;
};

StepFigures measure_step(const Flown& flown, double step_m, const Vector3d& axis) {
  const double t90_s = flown.first_beyond(0.9 * step_m, axis);
  const double last = flown.settled_within(0.05 * step_m, kStart + step_m * axis);
  return {t90_s - flown.first_beyond(0.1 * step_m, axis), t90_s,
          std::max(0.0, flown.furthest(axis) / step_m - 1), last};
}

TEST(F450, HoversOnTheSpot) {
  const Flown flown = fly(airframe_named("f450"), kStart, 25);
  double squares = 0;
  for (const Vector3d& p : flown.position) squares += (p - kStart).squaredNorm();
  EXPECT_LT(std::sqrt(squares / static_cast<double>(flown.position.size())), 1e-3);
}

TEST(F450, StepsOneMeterAhead) {
  const Flown flown = fly(airframe_named("f450"), kStart + Vector3d::UnitX(), 10);
  const StepFigures figures = measure_step(flown, 1, Vector3d::UnitX());
  EXPECT_GT(figures.rise_s, 0.6);
  EXPECT_LT(figures.rise_s, 1.2);
  EXPECT_LT(figures.overshoot, 0.10);
  EXPECT_LT(figures.settle_s, 3);
  EXPECT_LT(flown.max_tilt_rad, 20 * kDegree);
}

TEST(F450, StepsFiveMetersAhead) {
  const Flown flown = fly(airframe_named("f450"), kStart + 5 * Vector3d::UnitX(), 12);
  const StepFigures figures = measure_step(flown, 5, Vector3d::UnitX());
  EXPECT_LT(figures.t90_s, 2.3);
  EXPECT_LT(figures.overshoot, 0.05);
  EXPECT_LT(flown.max_tilt_rad, 37 * kDegree);
}

TEST(F450, StepsTwentyMetersAhead) {
  const Flown flown = fly(airframe_named("f450"), kStart + 20 * Vector3d::UnitX(), 15);
  const StepFigures figures = measure_step(flown, 20, Vector3d::UnitX());
  EXPECT_LT(figures.t90_s, 5.5);
  EXPECT_LT(figures.overshoot, 0.05);
  EXPECT_LE(flown.max_speed_mps, 5.0);
}

class HeightStep : public ::testing::TestWithParam<double> {};

TEST_P(HeightStep, OvershootsLittleAndSettles) {
  const double step_m = GetParam();
  const Flown flown = fly(airframe_named("f450"), kStart + step_m * Vector3d::UnitZ(), 12);
  const double size_m = std::abs(step_m);
  const StepFigures figures =
      measure_step(flown, size_m, std::copysign(1, step_m) * Vector3d::UnitZ());
  EXPECT_LT(figures.overshoot, 0.12);
  EXPECT_LT(figures.settle_s, 3.5);
}

INSTANTIATE_TEST_SUITE_P(Meters, HeightStep, ::testing::Values(1.0, 3.0, -1.0, -3.0));

TEST(F450, StaysOnItsLine) {
  const Flown flown = fly(airframe_named("f450"), kStart + 5 * Vector3d::UnitX(), 10);
  const double sideways =
      std::max(flown.furthest(Vector3d::UnitY()), flown.furthest(-Vector3d::UnitY()));
  const double up_or_down =
      std::max(flown.furthest(Vector3d::UnitZ()), flown.furthest(-Vector3d::UnitZ()));
  EXPECT_LT(sideways, 0.1);
  EXPECT_LT(up_or_down, 0.1);
}

TEST(F450, HoldsAgainstAGustThatStays) {
  const std::vector<std::pair<double, double>> peaks{{4, 0.35}, {8, 0.8}, {10, 1.1}};
  for (const auto& [wind_mps, max_m] : peaks) {
    const Flown flown = fly(airframe_named("f450"), kStart, 15, wind_mps * Vector3d::UnitX());
    EXPECT_LT(flown.furthest_from(kStart), max_m) << wind_mps;
    EXPECT_GT(flown.furthest_from(kStart), 0.2 * max_m) << wind_mps;
    EXPECT_LT((flown.position.back() - kStart).norm(), 0.1) << wind_mps;
  }
}

TEST(F450, FliesTheSameAtEveryPhysicsRate) {
  const Vector3d target = kStart + Vector3d(5, 0, 1);
  const Flown slow = fly(airframe_named("f450"), target, 8, {0, 4, 0}, {240, 1});
  const Flown fast = fly(airframe_named("f450"), target, 8, {0, 4, 0}, {1000, 4});
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)}) {
    EXPECT_NEAR(slow.furthest(axis), fast.furthest(axis), 0.03 * fast.furthest(axis));
  }
  EXPECT_NEAR(slow.max_tilt_rad, fast.max_tilt_rad, 0.03 * fast.max_tilt_rad);
  EXPECT_NEAR(slow.max_speed_mps, fast.max_speed_mps, 0.03 * fast.max_speed_mps);
}

TEST(F450, PeaksInWindDoNotDependOnThePhysicsRate) {
  for (const double wind_mps : {4.0, 8.0, 10.0}) {
    const Vector3d wind = wind_mps * Vector3d::UnitX();
    const double slow_m =
        fly(airframe_named("f450"), kStart, 8, wind, {240, 1}).furthest_from(kStart);
    const double fast_m =
        fly(airframe_named("f450"), kStart, 8, wind, {1000, 4}).furthest_from(kStart);
    EXPECT_NEAR(slow_m, fast_m, 0.03 * fast_m) << wind_mps;
  }
}

// Mean 5 m/s, gusts of 1.5 m/s and 3 s along each axis.
Flown fly_in_gusts(std::uint64_t seed, Rates rates) {
  WindSpec wind;
  wind.speed_mps = 5;
  wind.profile = WindProfile::uniform;
  wind.gusts = GustModel::ou;
  Gusts gusts(wind, seed, 0);
  FlightWorld world({}, 1 / rates.physics_hz);
  world.add(airframe_named("f450"), kStart, 0);
  Controller controller(airframe_named("f450"));
  Setpoint setpoint;
  setpoint.position = kStart;
  Flown flown;
  constexpr double kSettledS = 15;
  constexpr double kDurationS = 75;
  for (int step = 0; step < kDurationS * rates.physics_hz; ++step) {
    const double time_s = step / rates.physics_hz;
    const FlightState state = world.state(0);
    if (step % rates.physics_per_control == 0) {
      const double control_dt_s = rates.physics_per_control / rates.physics_hz;
      world.command(0, controller.update(state, setpoint, control_dt_s));
      const Vector3d mean = wind.mean_at(state.position.z());
      world.set_air_velocity(0, mean + gusts.at(time_s, state.position.z(), mean.norm()));
    }
    world.step();
    if (time_s < kSettledS) continue;
    flown.time_s.push_back(time_s);
    flown.position.push_back(world.state(0).position);
  }
  return flown;
}

double compute_rms(const Flown& flown) {
  double squares = 0;
  for (const Vector3d& p : flown.position) squares += (p - kStart).squaredNorm();
  return std::sqrt(squares / static_cast<double>(flown.position.size()));
}

TEST(F450, HoldsInGusts) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Flown slow = fly_in_gusts(seed, {240, 1});
    const Flown fast = fly_in_gusts(seed, {1000, 4});
    EXPECT_LT(compute_rms(slow), 0.25) << seed;
    EXPECT_GT(compute_rms(slow), 0.05) << seed;
    EXPECT_NEAR(compute_rms(slow), compute_rms(fast), 0.03 * compute_rms(fast)) << seed;
  }
}

TEST(OtherAirframes, HoldInAStepOfWind) {
  const Vector3d wind(8, 0, 0);
  EXPECT_LT(fly(airframe_named("hummingbird"), kStart, 10, wind).furthest_from(kStart), 1.1);
  EXPECT_LT(fly(airframe_named("crazyflie"), kStart, 10, wind).furthest_from(kStart), 0.6);
  EXPECT_LT(fly(airframe_named("x500"), kStart, 10, wind).furthest_from(kStart), 1.1);
}

TEST(HeavyDrag, HoldsInEightButNotInTwelveMetersPerSecond) {
  Airframe frame = airframe_named("f450");
  frame.body_drag.setConstant(0.12);
  const Flown holds = fly(frame, kStart, 15, {8, 0, 0});
  EXPECT_LT(holds.furthest_from(kStart), 1.8);
  EXPECT_NEAR(holds.max_tilt_rad, 32 * kDegree, 3 * kDegree);
  EXPECT_GT(fly(frame, kStart, 15, {10.5, 0, 0}).furthest_from(kStart), 5);
}

// Steps of hector_quadrotor's published cascade, of a model in one dimension (rise from 10 to 90 %,
// overshoot): its autopilot is quick and badly damped.
struct HectorStep {
  double step_m;
  double rise_s;
  double overshoot;
};

class Hector : public ::testing::TestWithParam<HectorStep> {};

TEST_P(Hector, StepsAsPublished) {
  const HectorStep& published = GetParam();
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, -1, 0)}) {
    const Flown flown = fly(airframe_named("hector"), kStart + published.step_m * axis, 12,
                            Vector3d::Zero(), kHectorRates);
    const StepFigures figures = measure_step(flown, published.step_m, axis);
    EXPECT_NEAR(figures.rise_s, published.rise_s, 0.1 * published.rise_s);
    EXPECT_NEAR(figures.overshoot, published.overshoot, 0.1 * published.overshoot);
  }
}

INSTANTIATE_TEST_SUITE_P(Meters, Hector,
                         ::testing::Values(HectorStep{1, 0.58, 0.47}, HectorStep{5, 0.75, 0.40},
                                           HectorStep{20, 1.88, 0.11}));

TEST(HectorLimits, AreThoseOfItsControllers) {
  const Flown flown = fly(airframe_named("hector"), kStart + 20 * Vector3d::UnitX(), 12,
                          Vector3d::Zero(), kHectorRates);
  EXPECT_NEAR(flown.max_tilt_rad, 45 * kDegree, 4.5 * kDegree);
  EXPECT_NEAR(flown.max_speed_mps, 9.2, 0.92);
}

class EveryAirframe : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryAirframe, HoversAndFliesToATarget) {
  const Airframe frame = airframe_named(GetParam());
  const Vector3d target = kStart + Vector3d(3, -2, 1);
  const Flown flown = fly(frame, target, 10);
  EXPECT_LT((flown.position.back() - target).norm(), 0.05);
  EXPECT_LT(flown.max_tilt_rad, 38 * kDegree);
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryAirframe,
                         ::testing::Values("f450", "iris", "hummingbird", "crazyflie", "x500"));

TEST(HectorTarget, IsReached) {
  const Vector3d target = kStart + Vector3d(3, -2, 1);
  const Flown flown = fly(airframe_named("hector"), target, 20, Vector3d::Zero(), kHectorRates);
  EXPECT_LT((flown.position.back() - target).norm(), 0.05);
}

}  // namespace
}  // namespace throng::sim
