// A moment of a run that is simulated step by step.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "spec/sim/run_spec.h"
#include "world/trace.h"

namespace throng::live {

/// Status of a drone besides its pose.
struct DroneStatus {
  bool beacon = false;               ///< whether the beacon is on
  bool on_mission = true;            ///< false: it lands, falls or is on the ground
  bool running = true;               ///< whether the rotors turn
  camera::GimbalAngles gimbal = {};  ///< direction of its camera
};

/// The newest step and the one before it, with all values that clients are shown.
struct Moment {
  double time_s = 0;
  double dt_s = 0;
  std::shared_ptr<const world::CrowdStep> before;
  std::shared_ptr<const world::CrowdStep> now;
  std::vector<float> strides_before;  ///< per agent: strides walked so far, at `before`
  std::vector<float> strides_now;     ///< per agent: strides walked so far, at `now`
  world::Trace flown;                 ///< the drones only, from `before` on
  std::vector<DroneStatus> drones;
  std::vector<std::vector<sim::PilotSample>> setpoints;  ///< per drone: those around the step
  std::uint32_t sequence = 0;  ///< number of the newest command applied in the step
};

}  // namespace throng::live
