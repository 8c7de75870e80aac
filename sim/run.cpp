#include "sim/run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "crowd/simulation.h"
#include "sim/people/people_watch.h"
#include "sim/recording/trace_recorder.h"
#include "sim/stepped_run.h"
#include "world/scenario_crowd.h"

namespace throng::sim {

namespace fs = std::filesystem;

namespace {

/// Hands everything on, and looks at the people.
class WatchedRun : public RunObserver {
 public:
  WatchedRun(const world::Scenario& scenario, const RunSpec& spec, RunObserver& observer)
      : scenario_(scenario), images_from_s_(spec.images_from_s), observer_(observer) {}

  void begin(const world::TraceHeader& header) override {
    people_.emplace(scenario_, header, images_from_s_);
    observer_.begin(header);
  }
  void step(const world::CrowdStep& step) override {
    people_->look(step);
    observer_.step(step);
  }
  void drone(std::size_t drone, const world::DroneSample& sample) override {
    observer_.drone(drone, sample);
  }
  void event(const world::TraceEvent& event) override { observer_.event(event); }
  void pilot(std::size_t drone, const PilotSample& sample) override {
    observer_.pilot(drone, sample);
  }
  bool done() const override { return observer_.done(); }

  std::vector<Problem> warnings() const { return people_->warnings(); }

 private:
  const world::Scenario& scenario_;
  std::optional<double> images_from_s_;
  RunObserver& observer_;
  std::optional<PeopleWatch> people_;
};

}  // namespace

std::vector<Problem> simulate(const world::Scenario& scenario, const RunSpec& spec,
                              RunObserver& observer, const RunProgress& progress,
                              const std::stop_token& stop,
                              std::optional<crowd::Simulation> people) {
  WatchedRun watched(scenario, spec, observer);
  SteppedRun run(scenario, spec, watched, std::move(people));
  constexpr double kRounding = 1e-9;
  const auto steps = static_cast<long>(std::ceil(spec.duration_s / run.dt_s() - kRounding));
  for (long step = 1; step <= steps && !observer.done(); ++step) {
    if (stop.stop_requested()) throw Cancelled();
    run.step();
    if (progress) progress(std::min(run.time_s(), spec.duration_s), spec.duration_s);
  }
  std::vector<Problem> warnings = run.finish();
  for (Problem& warning : watched.warnings()) warnings.push_back(std::move(warning));
  return warnings;
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
