// One run: the clock that couples crowd and drones and writes the trace.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "sim/airframe.h"
#include "sim/wind.h"
#include "world/scenario.h"

namespace throng::sim {

/// What one drone is asked to do.
struct DroneMission {
  std::string id;                            ///< as in the job; unique
  std::string airframe = "f450";             ///< a name in sim/airframes.json
  std::optional<Airframe> own_airframe;      ///< flies instead of the named one
  std::string policy = "hover";              ///< "hover" or "waypoints"
  std::optional<Eigen::Vector3d> start;      ///< m; default: the scenario's start for this id
  std::vector<Eigen::Vector3d> waypoints;    ///< m, in order; the drone hovers at the last one
  double speed_mps = 3;                      ///< along the path
  std::optional<world::GoalRef> moves_goal;  ///< goal that follows this drone's (x, y)
  std::optional<double> battery_charge;      ///< share of a full battery; without it, it lasts
};

/// How the crowd engine computes.
struct CrowdSpec {
  std::string model = "orca";  ///< a name in crowd::models()
  crowd::Compat compat = crowd::Compat::none;
  bool hard_separation = false;
};

struct RunSpec {
  std::uint64_t seed = 1;
  double duration_s = 120;    ///< simulated time; the run may not end earlier
  std::optional<int> people;  ///< how many of the scenario's people take part; default all
  CrowdSpec crowd;
  std::vector<DroneMission> drones;
  WindSpec wind;
  double physics_dt_s = 1.0 / 480;  ///< at most 1/240 s
};

/// The crowd of a run as the scenario begins. Throws like crowd::Simulation's constructor.
crowd::Simulation load_crowd(const world::Scenario& scenario, std::uint64_t seed,
                             const CrowdSpec& spec);

/// Called with simulated seconds done and the total.
using RunProgress = std::function<void(double done_s, double total_s)>;

/// Simulates one run and writes the trace at `trace_file` (complete or absent). Same scenario and
/// spec give the same bytes. Returns what was ignored in the scenario's files and which drones
/// could not hold. Throws InputError for a spec the scenario cannot serve (too many people, unknown
/// airframe or policy, waypoint below ground or inside a building), Cancelled when `stop` asks.
std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              const std::filesystem::path& trace_file,
                              const RunProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace throng::sim
