// Writes a run's trace and, optionally, its pilot logs.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "sim/recording/run_observer.h"
#include "world/trace.h"

namespace throng::sim {

/// Records what simulate() reports.
class TraceRecorder : public RunObserver {
 public:
  /// Pilot logs are written to `pilot_log_folder` as DRONE.csv, or not at all if it is empty.
  explicit TraceRecorder(std::filesystem::path trace_file,
                         std::filesystem::path pilot_log_folder = {});

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  void drone(std::size_t drone, const world::DroneSample& sample) override;
  void event(const world::TraceEvent& event) override;
  void pilot(std::size_t drone, const PilotSample& sample) override;

  /// Completes the files and gives them their names. If it is not called, no file remains. Throws
  /// EnvironmentError.
  void finish();

 private:
  std::filesystem::path trace_file_;
  std::filesystem::path pilot_log_folder_;
  std::optional<world::TraceWriter> trace_;
  std::vector<std::string> drone_ids_;
  std::vector<std::vector<PilotSample>> pilot_logs_;
};

}  // namespace throng::sim
