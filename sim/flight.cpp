#include "sim/flight.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

namespace {

constexpr double kControlHz = 240;
constexpr double kSampleHz = 60;
// Shorter saturation is how a craft speeds up and brakes; longer means that it cannot hold.
constexpr double kTooLongSaturatedS = 3;
// Slower contact is a landing.
constexpr double kCollisionMps = 0.3;

int whole_ticks(double interval_s, double longest_tick_s) {
  constexpr double kRounding = 1e-9;
  return std::max(1, static_cast<int>(std::ceil(interval_s / longest_tick_s - kRounding)));
}

int nearest_ticks(double hz, double tick_s) {
  return std::max(1, static_cast<int>(std::lround(1 / (hz * tick_s))));
}

}  // namespace

Flight::Flight(const std::vector<world::Building>& buildings,
               const std::vector<PlannedDrone>& drones, double interval_s, double physics_dt_s,
               FlightLog log)
    : ticks_per_interval_(whole_ticks(interval_s, physics_dt_s)),
      ticks_per_control_(nearest_ticks(kControlHz, interval_s / ticks_per_interval_)),
      ticks_per_sample_(nearest_ticks(kSampleHz, interval_s / ticks_per_interval_)),
      interval_s_(interval_s),
      world_(buildings, interval_s / ticks_per_interval_),
      log_(std::move(log)) {
  for (const PlannedDrone& drone : drones) {
    world_.add(drone.airframe, drone.start, drone.yaw_rad);
    const FlightLimits limits;
    pilots_.push_back({drone.policy->make({drone.mission, drone.start, drone.yaw_rad, limits}),
                       Controller(drone.airframe, limits),
                       {}});
  }
  record_samples();
}

void Flight::advance() {
  for (int i = 1; i <= ticks_per_interval_; ++i) {
    if (tick_ % ticks_per_control_ == 0) control();
    world_.step();
    ++tick_;
    // From the interval's number, so that no rounding adds up over a run.
    time_s_ = static_cast<double>(interval_) * interval_s_ + i * world_.dt_s();
    if (i == ticks_per_interval_) time_s_ = static_cast<double>(interval_ + 1) * interval_s_;
    if (i == ticks_per_interval_ || tick_ % ticks_per_sample_ == 0) record_samples();
    if (!world_.impacts().empty()) record_impacts();
  }
  ++interval_;
}

void Flight::control() {
  const double dt_s = ticks_per_control_ * world_.dt_s();
  for (std::size_t i = 0; i < pilots_.size(); ++i) {
    Pilot& pilot = pilots_[i];
    const FlightState state = world_.state(i);
    pilot.setpoint = pilot.policy->next(state, dt_s);
    world_.command(i, pilot.controller.update(state, pilot.setpoint, dt_s));
    const double before_s = pilot.saturated_s;
    pilot.saturated_s = pilot.controller.tilt_saturated() ? before_s + dt_s : 0;
    if (before_s < kTooLongSaturatedS && pilot.saturated_s >= kTooLongSaturatedS) {
      const double off_m = (pilot.setpoint.position - state.position).norm();
      log_.event({time_s_, "tilt_saturated", -1, static_cast<std::int32_t>(i), off_m});
    }
  }
}

void Flight::record_samples() {
  for (std::size_t i = 0; i < pilots_.size(); ++i) {
    const FlightState state = world_.state(i);
    log_.sample(i, {time_s_, state.position, state.velocity, world_.orientation(i)});
  }
}

void Flight::record_impacts() {
  for (const Impact& impact : world_.impacts()) {
    if (impact.speed_mps < kCollisionMps) continue;
    log_.event(
        {time_s_, "collision", -1, static_cast<std::int32_t>(impact.craft), impact.speed_mps});
  }
}

}  // namespace throng::sim
