#include "sim/fleet/pilot.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

namespace {

// Shorter saturation is how a vehicle speeds up and brakes; longer means that it cannot hold.
constexpr double kTooLongSaturatedS = 3;
// So far from its set-point, and getting farther for so long, a vehicle is being blown away.
constexpr double kLostM = 5;
constexpr double kTooLongAwayS = 3;
constexpr double kFoundM = 2;
// Share of the capacity that is kept for the landing.
constexpr double kReserve = 0.15;
constexpr double kSinkMps = 1;
constexpr double kTouchdownMps = 0.25;
constexpr double kRestingMps = 0.1;
constexpr double kRestingS = 0.5;

}  // namespace

Pilot::Pilot(const PlannedDrone& drone, std::int32_t index)
    : drone_(index),
      airframe_(drone.airframe),
      policy_(drone.policy->make({drone.mission, drone.start, drone.yaw_rad,
                                  drone.airframe.autopilot, drone.scenario, drone.index})),
      guides_(guides(*drone.policy)),
      beacon_asked_(drone.mission.guidance.beacon.value_or(false)),
      controller_(drone.airframe),
      battery_(drone.airframe.battery_wh, drone.mission.battery_charge) {
  setpoint_.position = drone.start;
  setpoint_.yaw_rad = drone.yaw_rad;
}

PerRotor Pilot::control(const FlightState& state, double dt_s, const Report& report) {
  watch_battery(state, report);
  if (phase_ == Phase::flying) setpoint_ = policy_->next(state, dt_s);
  if (phase_ == Phase::landing) descend(state, dt_s, report);
  if (phase_ == Phase::damaged) watch_attitude(state, dt_s);
  if (phase_ == Phase::stopped) return {};
  const PerRotor speeds = controller_.update(state, setpoint_, dt_s);
  if (phase_ != Phase::damaged) watch_hold(state, dt_s, report);
  return speeds;
}

void Pilot::damaged(const Damage& damage, const FlightState& state) {
  if (phase_ == Phase::stopped) return;
  phase_ = damage.structure ? Phase::stopped : Phase::damaged;
  setpoint_ = {};
  setpoint_.position = state.position;
  setpoint_.yaw_rad = std::atan2(state.rotation(1, 0), state.rotation(0, 0));
}

void Pilot::spend(const FlightState& state, double thrust_n, const Eigen::Vector3d& air_velocity,
                  double dt_s) {
  if (phase_ == Phase::stopped && battery_.charge() <= 0) return;
  battery_.use(electric_power_w(airframe_, phase_ == Phase::stopped ? 0 : thrust_n,
                                state.velocity - air_velocity, state.rotation.col(2)),
               dt_s);
}

void Pilot::watch_battery(const FlightState& state, const Report& report) {
  const double charge = battery_.charge();
  if (charge <= 0 && phase_ != Phase::stopped) {
    phase_ = Phase::stopped;
    report(world::BatteryFlat{drone_, state.position.z()});
  } else if (charge <= kReserve && phase_ == Phase::flying) {
    phase_ = Phase::landing;
    setpoint_.position = state.position;
    report(world::BatteryLow{drone_, charge});
  }
}

// Straight down, slowly where the ground is near. It may land on a roof: it has landed when it no
// longer sinks.
void Pilot::descend(const FlightState& state, double dt_s, const Report& report) {
  constexpr double kSlowDownPerS = 0.4;
  const double sink_mps = std::clamp(kSlowDownPerS * state.position.z(), kTouchdownMps, kSinkMps);
  setpoint_.velocity = {0, 0, -sink_mps};
  setpoint_.acceleration.setZero();
  setpoint_.position.z() =
      std::max(setpoint_.position.z() - sink_mps * dt_s, state.position.z() - kSinkMps);
  const bool should_sink = setpoint_.position.z() < state.position.z() - 0.5 * kSinkMps;
  const bool rests = should_sink && std::abs(state.velocity.z()) < kRestingMps;
  resting_s_ = rests ? resting_s_ + dt_s : 0;
  if (resting_s_ < kRestingS) return;
  phase_ = Phase::stopped;
  has_landed_ = true;
  report(world::Landed{drone_, state.position.z()});
}

// As PX4's failure detector does by default: 60 degrees of tilt for 0.3 s mean that the drone is
// lost. One that lies on the ground, tipped less, has its rotors stopped as well.
void Pilot::watch_attitude(const FlightState& state, double dt_s) {
  constexpr double kTippedUpZ = 0.5;  // cosine of 60 degrees
  constexpr double kTippedS = 0.3;
  const bool tipped = state.rotation(2, 2) < kTippedUpZ;
  tipped_s_ = tipped ? tipped_s_ + dt_s : 0;
  resting_s_ = state.velocity.norm() < kRestingMps ? resting_s_ + dt_s : 0;
  if (tipped_s_ >= kTippedS || resting_s_ >= kRestingS) phase_ = Phase::stopped;
}

void Pilot::watch_hold(const FlightState& state, double dt_s, const Report& report) {
  const Eigen::Vector3d off = state.position - setpoint_.position;
  const double off_m = off.norm();
  const double before_s = saturated_s_;
  saturated_s_ = controller_.tilt_saturated() ? before_s + dt_s : 0;
  if (before_s < kTooLongSaturatedS && saturated_s_ >= kTooLongSaturatedS) {
    report(world::TiltSaturated{drone_, off_m});
  }
  const bool goes_away = off.dot(state.velocity - setpoint_.velocity) > 0;
  away_s_ = std::clamp(away_s_ + (goes_away ? dt_s : -dt_s), 0.0, kTooLongAwayS);
  if (off_m < kFoundM) lost_ = false;
  if (lost_ || off_m < kLostM || away_s_ < kTooLongAwayS) return;
  lost_ = true;
  report(world::BlownAway{drone_, off_m});
}

}  // namespace throng::sim
