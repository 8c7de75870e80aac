// A job's first run, flown by commands: the same simulation step by step, recorded as a trace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/remote/remote_pilots.h"
#include "sim/run_observer.h"
#include "sim/stepped_run.h"
#include "spec/job/spec.h"
#include "spec/live/messages.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::live {

/// Longest flight, in simulated seconds: a job with its set-points can still be sent.
inline constexpr double kMaxFlightS = 600;

/// How a drone is, besides where.
struct DroneStatus {
  bool beacon = false;
  bool on_mission = true;  ///< else it lands, falls or lies
  bool running = true;     ///< its rotors
};

/// The newest step and the one before it: everything that is shown.
struct Moment {
  double time_s = 0;
  double dt_s = 0;
  std::shared_ptr<const world::CrowdStep> before;
  std::shared_ptr<const world::CrowdStep> now;
  std::vector<float> strides_before;  ///< per agent, made so far
  std::vector<float> strides_now;
  world::Trace flown;  ///< only the drones, from the step before on
  std::vector<DroneStatus> drones;
  std::uint32_t sequence = 0;  ///< of the newest command in the step
};

class Flight {
 public:
  /// Writes the trace into the folder. Throws InputError and EnvironmentError.
  Flight(const jobs::JobSpec& job, const world::Scenario& scenario,
         const std::filesystem::path& folder);
  ~Flight();
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  const world::TraceHeader& header() const;
  const std::vector<sim::PlannedDrone>& drones() const { return run_->drones(); }
  double dt_s() const { return run_->dt_s(); }
  double time_s() const { return run_->time_s(); }

  /// One step, with a command per drone; `sequence` numbers the newest.
  std::shared_ptr<const Moment> step(const std::vector<sim::RemoteCommand>& commands,
                                     std::uint32_t sequence);
  /// The start.
  std::shared_ptr<const Moment> moment(std::uint32_t sequence) const;

  /// Events since the last call, as JSON: {"time_s", "type", "drone"}.
  std::vector<nlohmann::json> take_events();

  /// Ends the run: {"duration_s", "steps", "trace_sha256", "drones": [{"id", "csv"}], "job",
  /// "warnings"}. The job flies the logs, and its trace is equal byte for byte. Call nothing
  /// afterwards.
  nlohmann::json finish();

 private:
  class Recorder;

  jobs::JobSpec job_;
  std::filesystem::path trace_file_;
  sim::RunSpec spec_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<sim::SteppedRun> run_;
  std::unique_ptr<sim::RemotePilots> pilots_;
};

}  // namespace throng::live
