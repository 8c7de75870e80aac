#include "sim/run.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "crowd/simulation.h"
#include "sim/recording/trace_recorder.h"
#include "sim/stepped_run.h"
#include "world/scenario_crowd.h"

namespace throng::sim {

namespace fs = std::filesystem;

std::string model_for(const world::Scenario& scenario, const CrowdSpec& spec) {
  if (!spec.model.empty()) return spec.model;
  if (!scenario.crowd_model.empty()) return scenario.crowd_model;
  return spec.compat == crowd::Compat::none ? "ttc" : "orca";
}

crowd::Simulation load_crowd(const world::Scenario& scenario, std::uint64_t seed,
                             const CrowdSpec& spec) {
  const crowd::CrowdDescription description = world::crowd_of(scenario);
  crowd::LoadOptions options;
  options.seed = seed;
  options.model = model_for(scenario, spec);
  options.compat = spec.compat;
  options.hard_separation = spec.hard_separation;
  options.compliance = spec.compliance;
  options.physical = spec.physical;
  return {description.scene, description.behavior, options};
}

std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              RunObserver& observer, const RunProgress& progress,
                              const std::stop_token& stop) {
  SteppedRun run(scenario, spec, observer);
  constexpr double kRounding = 1e-9;
  const auto steps = static_cast<long>(std::ceil(spec.duration_s / run.dt_s() - kRounding));
  for (long step = 1; step <= steps && !observer.done(); ++step) {
    if (stop.stop_requested()) throw Cancelled();
    run.step();
    if (progress) progress(std::min(run.time_s(), spec.duration_s), spec.duration_s);
  }
  return run.finish();
}

std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              const fs::path& trace_file, const RunProgress& progress,
                              const std::stop_token& stop, const fs::path& pilot_log_folder) {
  TraceRecorder recorder(trace_file, pilot_log_folder);
  std::vector<Problem> warnings = simulate(scenario, spec, recorder, progress, stop);
  recorder.finish();
  return warnings;
}

}  // namespace throng::sim
