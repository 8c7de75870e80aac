// The first run of a job, simulated in the caller's process step by step: with the drones'
// policies, as `throng simulate` does it, or with drones that follow commands.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "live/engine/drone_rows.h"
#include "sim/remote/remote_pilots.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng {
class ThreadLimit;
}

namespace throng::engine {

/// Choices beyond the job.
struct RunChoices {
  std::optional<std::uint64_t> seed;  ///< replaces the job's
  bool is_remote = false;             ///< drones follow commands, not their policies
  std::filesystem::path trace_file;   ///< "": no trace
  int image_width = 320;
  int image_height = 180;
  int threads = 1;  ///< of the simulation and of images; they change no result
};

/// Not thread-safe; images are made by the thread that makes the first one.
class SteppedJob {
 public:
  /// Reads and resolves the job (a path in it is relative to the working folder), loads the
  /// scenario and starts the run. `source` names the job in errors. Throws InputError and
  /// EnvironmentError.
  SteppedJob(std::string_view job, const std::string& source, const RunChoices& choices);
  ~SteppedJob();
  SteppedJob(const SteppedJob&) = delete;
  SteppedJob& operator=(const SteppedJob&) = delete;

  const world::TraceHeader& header() const;
  double dt_s() const;
  double time_s() const;
  double duration_s() const;
  /// Whether the job's duration is over. Further steps are possible.
  bool is_over() const;

  /// People who leave this area have escaped.
  const world::Rectangle& area() const;

  /// The newest step of the crowd; its arrays keep their addresses.
  const world::CrowdStep& people() const;
  /// The newest state of each drone; the rows keep their addresses.
  const DroneRows& drones() const;
  std::vector<world::TraceEvent> take_events();

  /// Simulates one step. `commands`, one per drone, are required for remote drones, else empty.
  void step(const std::vector<sim::RemoteCommand>& commands);

  /// Renders what the camera of a drone sees now: RGB, rows from the top, image_width x
  /// image_height.
  const std::vector<std::uint8_t>& image(std::size_t drone);

  /// Ends the run and completes its trace; no step is possible afterwards. Returns warnings.
  std::vector<std::string> finish();

  /// The job that repeats the commands of a remote run so far (JSON), whose trace is the same.
  std::string flown_job() const;

 private:
  struct State;
  std::unique_ptr<ThreadLimit> threads_;
  std::unique_ptr<State> state_;
};

}  // namespace throng::engine
