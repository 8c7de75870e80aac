// Writes a run's trace and, if wanted, its pilot logs.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "sim/run_observer.h"
#include "world/trace.h"

namespace throng::sim {

class TraceRecorder : public RunObserver {
 public:
  /// `pilot_log_folder`: where DRONE.csv go; empty: nowhere.
  TraceRecorder(std::filesystem::path trace_file, std::filesystem::path pilot_log_folder);

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  void drone(std::size_t drone, const world::DroneSample& sample) override;
  void event(const world::TraceEvent& event) override;
  void pilot(std::size_t drone, const PilotSample& sample) override;

  /// Gives the files their names. Throws EnvironmentError; without it nothing is left behind.
  void finish();

 private:
  std::filesystem::path trace_file_;
  std::filesystem::path pilot_log_folder_;
  std::optional<world::TraceWriter> trace_;
  std::vector<std::string> drone_ids_;
  std::vector<std::vector<PilotSample>> pilot_logs_;
};

}  // namespace throng::sim
