// Guidance: what decides where a drone should be, where its camera should look and whether people
// can follow it. One file per policy, and one line in the table of policy_table.cpp that makes it
// known.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string_view>

#include "sim/controller.h"
#include "sim/sensors/world_view.h"
#include "spec/sim/run_spec.h"

namespace throng::sim {

/// Context of a policy's construction. All that it refers to outlives the policy.
struct PolicyContext {
  const DroneMission& mission;
  Eigen::Vector3d start;
  double yaw_rad;
  FlightLimits limits;
  const world::Scenario* scenario = nullptr;  ///< null only for policies that need none
  int drone = 0;                              ///< index among the run's drones
};

class Policy {
 public:
  Policy() = default;
  virtual ~Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;

  /// Shows it the world, once per step of the crowd.
  virtual void see(const WorldView&) {}
  /// Set-point of the drone `dt_s` after the last call, given its position.
  virtual Setpoint next(const FlightState& state, double dt_s) = 0;
  /// Policies that guide: whether people may follow the drone now. Off, the goal that it moves is
  /// out of sight.
  virtual bool beacon() const { return false; }
  /// The policy "pilot_log" during a live flight: a further set-point, later than all before it.
  virtual void fly_on(const PilotSample&) {}
  /// Information for the other drones.
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

struct PolicyEntry {
  std::string_view name;
  GuidanceFields needs;  ///< that must be given
  GuidanceFields takes;  ///< that may be given besides
  bool flies_free;       ///< goes where it likes, so its height must clear every building
  std::unique_ptr<Policy> (*make)(const PolicyContext&);
};

/// Whether the policy itself decides when people may follow. The beacon of any other is off for the
/// whole run, or on where the mission requires it: a camera drone must not lead people astray.
constexpr bool guides(const PolicyEntry& policy) {
  return ((policy.needs | policy.takes) & kFieldBeacon) == 0;
}

}  // namespace throng::sim
