// One drone's control: the policy that gives the set-point, the autopilot that flies there, the
// battery and the damage that set an end to it, and the detection that the drone cannot hold.
#pragma once

#include <functional>
#include <memory>

#include "sim/controller.h"
#include "sim/policies/planned_drone.h"
#include "sim/vehicle/battery.h"
#include "sim/vehicle/damage.h"
#include "world/trace_event.h"

namespace throng::sim {

class Pilot {
 public:
  using Report = std::function<void(const world::EventKind&)>;

  /// `index` is the drone's number in events.
  Pilot(const PlannedDrone& drone, std::int32_t index, const FlightLimits& limits);

  /// Starts trimmed for a steady wind (m/s).
  void trim(const Eigen::Vector3d& wind) { controller_.trim(wind); }

  /// Rotor speeds (rad/s) for the next `dt_s`. A drone whose battery is low lands where it is; one
  /// whose battery is flat, and one that has landed, stop their rotors.
  PerRotor control(const FlightState& state, double dt_s, const Report& report);

  /// The drone has lost propellers, or its frame is broken. Its mission ends: with what is left the
  /// autopilot tries to hold the place, and stops the rotors once the drone has tipped over.
  void damaged(const Damage& damage, const FlightState& state);

  /// Counts the energy of `dt_s` of flight.
  void spend(const FlightState& state, double thrust_n, const Eigen::Vector3d& air_velocity,
             double dt_s);

  const Battery& battery() const { return battery_; }
  /// Whether people may follow the drone, according to its policy and its mission.
  bool beacon() const { return guides_ ? policy_->beacon() : beacon_asked_; }
  Policy& policy() { return *policy_; }
  const Policy& policy() const { return *policy_; }
  /// Set-point of the last update.
  const Setpoint& setpoint() const { return setpoint_; }
  /// Whether it can lead anybody: not when it must land.
  bool is_on_mission() const { return phase_ == Phase::flying; }
  /// Whether the drone does not fall: all rotors turn and work, or it has landed.
  bool can_hold() const {
    return phase_ == Phase::flying || phase_ == Phase::landing || has_landed_;
  }
  /// Whether its rotors turn.
  bool is_running() const { return phase_ != Phase::stopped; }

 private:
  enum class Phase { flying, landing, damaged, stopped };

  void watch_battery(const FlightState& state, const Report& report);
  void descend(const FlightState& state, double dt_s, const Report& report);
  void watch_attitude(const FlightState& state, double dt_s);
  void watch_hold(const FlightState& state, double dt_s, const Report& report);

  std::int32_t drone_;  ///< its number
  Airframe airframe_;
  std::unique_ptr<Policy> policy_;
  bool guides_;        ///< the policy decides about the beacon
  bool beacon_asked_;  ///< else: from the mission
  Controller controller_;
  Battery battery_;
  Phase phase_ = Phase::flying;
  Setpoint setpoint_;
  double saturated_s_ = 0;  ///< how long the tilt has been at its limit without a break
  double away_s_ = 0;       ///< how long it has moved away from its set-point
  bool lost_ = false;       ///< has been reported as blown away and has not come back yet
  double tipped_s_ = 0;     ///< how long a damaged drone has been tipped over without a break
  bool has_landed_ = false;
  double resting_s_ = 0;  ///< how long it has not sunk although it should
};

}  // namespace throng::sim
