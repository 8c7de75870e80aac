// A live flight: the first run of a job, simulated step by step with drones that follow commands,
// and recorded as a trace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "live/flight/run_recorder.h"
#include "sim/remote/remote_pilots.h"
#include "sim/stepped_run.h"
#include "spec/job/spec.h"
#include "spec/live/commands.h"
#include "spec/live/messages.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::live {

inline constexpr const char* kTraceFile = "trace.h5";

/// Use from one thread at a time.
class Flight {
 public:
  /// Starts the run and writes its trace, kTraceFile, into the folder. The scenario must outlive
  /// this object, and the flight must end before `max_s`. Throws InputError and EnvironmentError.
  Flight(const jobs::JobSpec& job, const world::Scenario& scenario,
         const std::filesystem::path& folder, double max_s = kMaxFlightS);
  ~Flight();
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  const world::TraceHeader& header() const;
  const std::vector<sim::PlannedDrone>& drones() const { return run_->drones(); }
  double dt_s() const { return run_->dt_s(); }
  double time_s() const { return run_->time_s(); }

  /// Simulates one step with one command per drone; `sequence` is the number of the newest command.
  std::shared_ptr<const Moment> step(const std::vector<sim::RemoteCommand>& commands,
                                     std::uint32_t sequence);
  /// The moment at the start, before the first step.
  std::shared_ptr<const Moment> moment(std::uint32_t sequence) const;

  /// The events since the last call: {"time_s", "type", "drone"}.
  std::vector<nlohmann::json> take_events();

  /// Ends the run and returns {"duration_s", "steps", "trace_sha256", "drones": [{"id", "csv"}],
  /// "job", "warnings"}. The job replays the logged set-points and gives a trace with the same
  /// bytes. The last permitted call.
  nlohmann::json finish();

 private:
  jobs::JobSpec job_;
  std::filesystem::path trace_file_;
  RunRecorder recorder_;
  std::unique_ptr<sim::SteppedRun> run_;
  std::unique_ptr<sim::RemotePilots> pilots_;
};

/// The flight's drones as commands address them.
std::vector<FlownDrone> flown_drones(const Flight& flight);

/// The ids of the flight's drones.
std::vector<std::string> drone_ids(const Flight& flight);

}  // namespace throng::live
