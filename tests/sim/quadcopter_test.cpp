#include "sim/vehicle/quadcopter.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/sim/airframes.h"

namespace throng::sim {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 1.0 / 480;

FlightState high_up() {
  FlightState state;
  state.position = {0, 0, 50};
  return state;
}

PerRotor even(double speed) { return {speed, speed, speed, speed}; }

// Forces once the motors have reached `speeds`.
Wrench settled(const Airframe& frame, const FlightState& state, const PerRotor& speeds,
               const Vector3d& wind = Vector3d::Zero()) {
  Quadcopter quad(frame, 1000);
  return quad.step(state, speeds, wind);
}

class EveryQuadcopter : public ::testing::TestWithParam<std::string> {
 protected:
  Airframe frame = testing::airframe_named(GetParam());
  double hover_rad_s = std::sqrt(frame.weight_n() / (4 * frame.thrust_n_s2));
};

TEST_P(EveryQuadcopter, CarriesItsWeightWhenItStarts) {
  Quadcopter quad(frame, kDt);
  const Wrench wrench = quad.step(high_up(), quad.rotor_speeds(), Vector3d::Zero());
  EXPECT_NEAR(wrench.force.z(), frame.weight_n(), 1e-5 * frame.weight_n());
  EXPECT_NEAR(wrench.torque.norm(), 0, 1e-9);
}

TEST_P(EveryQuadcopter, LeansToTheSideOfItsSlowRotors) {
  // Rotors: ahead left, behind left, behind right, ahead right.
  const double slow = 0.9 * hover_rad_s;
  const double fast = 1.1 * hover_rad_s;
  const Wrench ahead = settled(frame, high_up(), {slow, fast, fast, slow});
  EXPECT_GT(ahead.torque.y(), 0);  // nose down: about y from z to x
  EXPECT_NEAR(ahead.torque.x(), 0, 1e-9);
  EXPECT_NEAR(ahead.torque.z(), 0, 1e-9);
  const Wrench right = settled(frame, high_up(), {fast, fast, slow, slow});
  EXPECT_GT(right.torque.x(), 0);
  EXPECT_NEAR(right.torque.y(), 0, 1e-9);
}

TEST_P(EveryQuadcopter, YawsAgainstItsFastRotors) {
  PerRotor speeds = even(hover_rad_s);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    speeds[i] *= frame.rotors[i].sense > 0 ? 1.1 : 0.9;
  }
  const Wrench wrench = settled(frame, high_up(), speeds);
  EXPECT_LT(wrench.torque.z(), 0);  // counter-clockwise rotors push the body clockwise
  EXPECT_NEAR(wrench.torque.head<2>().norm(), 0, 1e-9);
}

TEST_P(EveryQuadcopter, DragOpposesMotionThroughTheAirOnly) {
  FlightState state = high_up();
  state.velocity = {3, -4, 0};
  const PerRotor hover = even(hover_rad_s);
  const Vector3d still = settled(frame, state, hover).force;
  EXPECT_LT(still.dot(state.velocity), 0);
  EXPECT_NEAR(still.x() * state.velocity.y(), still.y() * state.velocity.x(), 1e-12);
  const Vector3d with_the_wind = settled(frame, state, hover, state.velocity).force;
  EXPECT_NEAR(with_the_wind.head<2>().norm(), 0, 1e-12);
}

TEST_P(EveryQuadcopter, FeelsTheGroundOnlyNearIt) {
  const auto lift_at = [&](double height_m) {
    FlightState state;
    state.position.z() = height_m;
    return settled(frame, state, even(hover_rad_s)).force.z() / frame.weight_n();
  };
  const double radius_m = frame.propeller_radius_m;
  EXPECT_NEAR(lift_at(radius_m), 16.0 / 15.0, 1e-4);
  EXPECT_GT(lift_at(radius_m), lift_at(2 * radius_m));
  EXPECT_NEAR(lift_at(20 * radius_m), 1, 1e-3);
  EXPECT_LE(lift_at(-1), 4.0 / 3.0 + 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryQuadcopter,
                         ::testing::Values("f450", "iris", "hummingbird", "crazyflie", "x500"));

TEST(Quadcopter, MotorsSpeedUpAndSlowDownWithTheirTimeConstants) {
  const Airframe frame = testing::airframe_named("iris");
  Quadcopter quad(frame, kDt);
  const double from = quad.rotor_speeds()[0];
  const auto steps = static_cast<int>(std::lround(frame.motor_up_s / kDt));
  for (int i = 0; i < steps; ++i) quad.step(high_up(), even(from + 100), Vector3d::Zero());
  EXPECT_NEAR(quad.rotor_speeds()[0], from + 100 * (1 - std::exp(-1)), 1e-9);

  const double top = quad.rotor_speeds()[0];
  for (int i = 0; i < 2 * steps; ++i) quad.step(high_up(), even(top - 100), Vector3d::Zero());
  EXPECT_NEAR(quad.rotor_speeds()[0], top - 100 * (1 - std::exp(-1)), 1e-9);
}

TEST(Quadcopter, LagDoesNotDependOnTheStep) {
  const Airframe frame = testing::airframe_named("f450");
  Quadcopter fine(frame, kDt);
  Quadcopter coarse(frame, 4 * kDt);
  for (int i = 0; i < 4; ++i) fine.step(high_up(), even(900), Vector3d::Zero());
  coarse.step(high_up(), even(900), Vector3d::Zero());
  EXPECT_NEAR(fine.rotor_speeds()[2], coarse.rotor_speeds()[2], 1e-9);
}

}  // namespace
}  // namespace throng::sim
