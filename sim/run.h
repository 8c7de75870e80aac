// One run: the clock that couples crowd and drones and writes the trace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "sim/run_observer.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// The pedestrian model of a run: the spec's, else the one that the scenario was made for, else
/// `orca` where Menge's results are wanted and `ttc` where people should walk as people do.
std::string model_for(const world::Scenario& scenario, const CrowdSpec& spec);

/// The crowd of a run as the scenario begins. Throws like crowd::Simulation's constructor.
crowd::Simulation load_crowd(const world::Scenario& scenario, std::uint64_t seed,
                             const CrowdSpec& spec);

/// Called with simulated seconds done and the total.
using RunProgress = std::function<void(double done_s, double total_s)>;

/// Simulates one run. Throws and returns like the other.
std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              RunObserver& observer, const RunProgress& progress = {},
                              const std::stop_token& stop = {});

/// Simulates one run and writes the trace at `trace_file` (complete or absent). Same scenario and
/// spec give the same bytes. Returns what was ignored in the scenario's files, which drones could
/// not hold, and why the figures of its people say nothing (sim/people/people_watch.h). Throws
/// InputError for a spec the scenario cannot serve (too many people, unknown airframe or policy,
/// waypoint below ground or inside a building), Cancelled when `stop` asks. With a
/// `pilot_log_folder` a file DRONE.csv there holds what each drone was asked to do, as the policy
/// "pilot_log" reads it.
std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              const std::filesystem::path& trace_file,
                              const RunProgress& progress = {}, const std::stop_token& stop = {},
                              const std::filesystem::path& pilot_log_folder = {});

}  // namespace throng::sim
