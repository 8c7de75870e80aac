// Guidance: what decides where a drone should be. One file per policy, and one line in the table
// of policy.cpp that makes it known.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string_view>

#include "sim/controller.h"
#include "sim/run.h"

namespace throng::sim {

/// What a policy knows when it is made.
struct PolicyContext {
  const DroneMission& mission;
  Eigen::Vector3d start;
  double yaw_rad;
  FlightLimits limits;
};

class Policy {
 public:
  Policy() = default;
  virtual ~Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;

  /// Where the drone should be `dt_s` after the last call, seeing where it is.
  virtual Setpoint next(const FlightState& state, double dt_s) = 0;
};

struct PolicyEntry {
  std::string_view name;
  bool flies_waypoints;  ///< needs waypoints; otherwise takes none
  std::unique_ptr<Policy> (*make)(const PolicyContext&);
};

/// Every policy there is.
std::span<const PolicyEntry> policies();

/// The policy of that name; null when there is none.
const PolicyEntry* find_policy(std::string_view name);

}  // namespace throng::sim
