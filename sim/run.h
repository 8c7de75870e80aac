// Simulation of one run: crowd and drones on a common clock, with the trace as output.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/error.h"
#include "sim/people/load_people.h"
#include "sim/recording/run_observer.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::sim {

/// Receives the simulated seconds so far and in total.
using RunProgress = std::function<void(double done_s, double total_s)>;

/// Simulates one run and reports it to `observer`, until the end or until observer.done().
/// `people` are load_people() of this run, which are loaded unless given. Returns warnings and
/// throws as the overload below.
std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              RunObserver& observer, const RunProgress& progress = {},
                              const std::stop_token& stop = {},
                              std::optional<crowd::Simulation> people = std::nullopt);

/// Simulates one run and writes its trace to `trace_file`, which is complete or absent afterwards;
/// equal scenarios and specs give equal bytes. With a `pilot_log_folder`, also writes each drone's
/// set-points to DRONE.csv there, for the policy "pilot_log". Returns warnings: ignored parts of
/// the scenario's files, drones that could not hold their position, and reasons why evacuation
/// metrics are meaningless (sim/people/people_watch.h). Throws InputError for a spec that does not
/// suit the scenario (too many people, unknown airframe or policy, waypoint below ground or inside
/// a building), and Cancelled on a request of `stop`.
std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              const std::filesystem::path& trace_file,
                              const RunProgress& progress = {}, const std::stop_token& stop = {},
                              const std::filesystem::path& pilot_log_folder = {});

}  // namespace throng::sim
