#include "sim/vehicle/downwash.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/vehicle/battery.h"
#include "tests/sim/airframes.h"

namespace throng::sim {
namespace {

using Eigen::Vector3d;
using testing::airframe_named;

TEST(Jet, HasTheFiguresOfTheF450) {
  const Airframe frame = airframe_named("f450");
  EXPECT_NEAR(hover_induced_mps(frame), 6.3, 0.1);  // momentum theory for 1.5 kg
  const Jet jet(frame);
  EXPECT_NEAR(jet.speed_mps(1, 0), 2 * hover_induced_mps(frame), 1e-9);
  EXPECT_NEAR(jet.speed_mps(4, 0), 6.0, 0.3);
  EXPECT_NEAR(jet.speed_mps(5, 0), 4.9, 0.3);
  EXPECT_NEAR(jet.speed_mps(10, 0), 2.4, 0.2);
  EXPECT_EQ(jet.speed_mps(-0.1, 0), 0);
}

TEST(Jet, CarriesTheCraftsWeightAtEveryDistance) {
  for (const Airframe& frame : shipped_airframes()) {
    const Jet jet(frame);
    for (const double below_m : {0.1, 0.5, 1.0, 4.0, 10.0}) {
      double momentum_n = 0;
      constexpr double kStepM = 1e-3;
      for (double r = 0.5 * kStepM; r < 5; r += kStepM) {
        const double speed_mps = jet.speed_mps(below_m, r);
        momentum_n += kAirDensity * speed_mps * speed_mps * 2 * EIGEN_PI * r * kStepM;
      }
      EXPECT_NEAR(momentum_n / frame.weight_n(), 1, 0.06) << frame.name << " " << below_m;
    }
  }
}

TEST(Jet, ReachesToWhereItIsThatSlow) {
  const Jet jet(airframe_named("x500"));
  for (const double speed_mps : {2.0, 5.0}) {
    EXPECT_NEAR(jet.speed_mps(jet.reach_m(speed_mps), 0), speed_mps, 1e-9);
  }
  EXPECT_EQ(jet.reach_m(100), 0);
}

TEST(Power, OfAHoverIsThatOfMomentumTheory) {
  for (const Airframe& frame : shipped_airframes()) {
    const double hover_w =
        electric_power_w(frame, frame.weight_n(), Vector3d::Zero(), Vector3d::UnitZ());
    const double ideal_w = frame.weight_n() * hover_induced_mps(frame);
    EXPECT_NEAR(hover_w, frame.avionics_w + ideal_w / frame.rotor_efficiency, 1e-6 * hover_w);
    if (frame.battery_wh <= 0) continue;
    const double minutes = 60 * frame.battery_wh / hover_w;
    EXPECT_GT(minutes, 5) << frame.name;
    EXPECT_LT(minutes, 30) << frame.name;
  }
}

TEST(Power, ClimbingCostsMoreSinkingAndCruisingLess) {
  const Airframe frame = airframe_named("f450");
  const auto power_w = [&](const Vector3d& velocity) {
    return electric_power_w(frame, frame.weight_n(), velocity, Vector3d::UnitZ());
  };
  const double hover_w = power_w(Vector3d::Zero());
  EXPECT_GT(power_w({0, 0, 2}), 1.1 * hover_w);
  EXPECT_LT(power_w({0, 0, -2}), 0.95 * hover_w);
  EXPECT_LT(power_w({10, 0, 0}), 0.8 * hover_w);
  EXPECT_EQ(electric_power_w(frame, 0, Vector3d::Zero(), Vector3d::UnitZ()), frame.avionics_w);
  // Glauert's equation, solved by hand for V = v_h across the disc: v_i = 0.786 v_h.
  const double v = hover_induced_mps(frame);
  EXPECT_NEAR((power_w({v, 0, 0}) - frame.avionics_w) / (hover_w - frame.avionics_w), 0.786, 1e-3);
}

TEST(Battery, RunsOutAfterItsCharge) {
  Battery battery(10, 0.5);
  battery.use(3600, 4);  // 4 Wh
  EXPECT_NEAR(battery.charge(), 0.1, 1e-12);
  battery.use(3600, 4);
  EXPECT_EQ(battery.charge(), 0);
  EXPECT_EQ(battery.used_j(), 8 * 3600);
  Battery endless(0, std::nullopt);
  endless.use(1e6, 1e6);
  EXPECT_EQ(endless.charge(), 1);
}

}  // namespace
}  // namespace throng::sim
