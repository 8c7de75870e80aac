// The control of one drone: the policy that computes the set-point, the autopilot that follows it,
// the battery, damage, and the detection that the drone cannot hold its position.
#pragma once

#include <functional>
#include <memory>

#include "sim/policies/planned_drone.h"
#include "sim/vehicle/battery.h"
#include "sim/vehicle/controller.h"
#include "sim/vehicle/damage.h"
#include "world/trace_event.h"

namespace throng::sim {

/// Controls one drone.
class Pilot {
 public:
  using Report = std::function<void(const world::EventKind&)>;

  /// `index` is the drone's index in events. `drone` must outlive the pilot, whose policy refers to
  /// its mission.
  Pilot(const PlannedDrone& drone, std::int32_t index);

  /// Trims the autopilot for a constant wind (m/s, world), at the start.
  void trim(const Eigen::Vector3d& wind) { controller_.trim(wind); }

  /// Returns the rotor speeds (rad/s) for the next `dt_s`. A drone with a low battery lands where
  /// it is; the rotors stop when the battery is empty or the drone has landed.
  PerRotor control(const FlightState& state, double dt_s, const Report& report);

  /// Reports damage, which ends the mission. The autopilot tries to hold the position with the
  /// remaining rotors, and stops them once the drone has tipped over.
  void damaged(const Damage& damage, const FlightState& state);

  /// Consumes the energy of `dt_s` of flight.
  void spend(const FlightState& state, double thrust_n, const Eigen::Vector3d& air_velocity,
             double dt_s);

  const Battery& battery() const { return battery_; }
  /// Whether people may follow the drone by its policy or, if that does not guide, by its mission.
  bool beacon() const { return guides_ ? policy_->beacon() : beacon_asked_; }
  Policy& policy() { return *policy_; }
  const Policy& policy() const { return *policy_; }
  /// The set-point of the last update.
  const Setpoint& setpoint() const { return setpoint_; }
  /// Whether the drone carries out its mission: it is neither damaged, landing nor stopped.
  bool is_on_mission() const { return phase_ == Phase::flying; }
  /// Whether the drone cannot fall: all rotors work and turn, or it has landed.
  bool can_hold() const {
    return phase_ == Phase::flying || phase_ == Phase::landing || has_landed_;
  }
  /// Whether the rotors turn.
  bool is_running() const { return phase_ != Phase::stopped; }

 private:
  enum class Phase { flying, landing, damaged, stopped };

  void watch_battery(const FlightState& state, const Report& report);
  void descend(const FlightState& state, double dt_s, const Report& report);
  void watch_attitude(const FlightState& state, double dt_s);
  void watch_hold(const FlightState& state, double dt_s, const Report& report);

  std::int32_t drone_;  ///< its index in events
  Airframe airframe_;
  std::unique_ptr<Policy> policy_;
  bool guides_;        ///< the policy decides about the beacon
  bool beacon_asked_;  ///< beacon of the mission, if the policy does not guide
  Controller controller_;
  Battery battery_;
  Phase phase_ = Phase::flying;
  Setpoint setpoint_;
  double saturated_s_ = 0;  ///< time for which the tilt has been at its limit
  double away_s_ = 0;       ///< time for which it has moved away from its set-point
  bool lost_ = false;       ///< has been reported as blown away and has not returned
  double tipped_s_ = 0;     ///< time for which a damaged drone has been tipped over
  bool has_landed_ = false;
  double resting_s_ = 0;  ///< time for which it has not descended although it should
};

}  // namespace throng::sim
