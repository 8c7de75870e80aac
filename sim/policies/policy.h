// The interface of guidance policies. A policy decides on the position and heading of a drone and
// whether people can follow it. Each policy has a file and a row in the table of policy_table.cpp.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string_view>

#include "sim/sensors/world_view.h"
#include "sim/vehicle/controller.h"
#include "spec/sim/run_spec.h"

namespace throng::sim {

/// Arguments for the construction of a policy. Referenced objects must outlive the policy.
struct PolicyContext {
  const DroneMission& mission;
  Eigen::Vector3d start;
  double yaw_rad;
  const Autopilot& autopilot;
  const world::Scenario* scenario = nullptr;  ///< null only for policies that do not use it
  int drone = 0;                              ///< index among the run's drones
};

/// A policy of one drone. Calls come from one thread, in order of simulated time.
class Policy {
 public:
  Policy() = default;
  virtual ~Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;

  /// Receives the observation of the world, once per step of the crowd.
  virtual void see(const WorldView&) {}
  /// Advances by `dt_s` and returns the set-point, for a drone with this state.
  virtual Setpoint next(const FlightState& state, double dt_s) = 0;
  /// For policies that guide: whether people may follow the drone now. If not, the goal that the
  /// drone moves is out of people's sight.
  virtual bool beacon() const { return false; }
  /// For the policy "pilot_log" during a live flight: appends a set-point, which must be later than
  /// all previous ones.
  virtual void fly_on(const PilotSample&) {}
  /// The plan that is announced to the other drones.
  virtual LeadPlan plan() const { return {}; }
};

/// Parameters of GuidanceSpec (and the waypoints), as bits of a mask.
using GuidanceFields = unsigned;
inline constexpr GuidanceFields kFieldWaypoints = 1U << 0U;
inline constexpr GuidanceFields kFieldCenter = 1U << 1U;
inline constexpr GuidanceFields kFieldRadius = 1U << 2U;
inline constexpr GuidanceFields kFieldArea = 1U << 3U;
inline constexpr GuidanceFields kFieldOverlap = 1U << 4U;
inline constexpr GuidanceFields kFieldExits = 1U << 5U;
inline constexpr GuidanceFields kFieldSetpoints = 1U << 6U;
inline constexpr GuidanceFields kFieldLeadSpeed = 1U << 7U;
inline constexpr GuidanceFields kFieldBatch = 1U << 8U;
inline constexpr GuidanceFields kFieldPerception = 1U << 9U;
inline constexpr GuidanceFields kFieldBeacon = 1U << 10U;

/// A row of the table of policies.
struct PolicyEntry {
  std::string_view name;
  GuidanceFields needs;  ///< required parameters
  GuidanceFields takes;  ///< optional parameters
  bool flies_free;       ///< path is unconstrained, so its height must clear every building
  std::unique_ptr<Policy> (*make)(const PolicyContext&);
};

/// Whether the policy itself decides when people may follow. With other policies, the mission turns
/// the beacon on or (by default) off for the whole run, so that camera drones do not lead people.
constexpr bool guides(const PolicyEntry& policy) {
  return ((policy.needs | policy.takes) & kFieldBeacon) == 0;
}

}  // namespace throng::sim
