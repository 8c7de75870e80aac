// Conversion of the crowd engine's state to a trace.
#pragma once

#include <filesystem>
#include <string>

#include "crowd/output/recorder.h"
#include "world/trace.h"

namespace throng::sim {

/// Constant data of a crowd's trace; all agents are persons, and there are no exits and drones.
world::TraceHeader crowd_header(const crowd::Simulation& crowd, std::uint64_t seed);

/// The current state of the crowd, without intents.
world::CrowdStep crowd_step(const crowd::Simulation& crowd);

/// Writes the trace of a crowd that has no scenario.
class CrowdTrace : public crowd::Recorder {
 public:
  /// `name` is written instead of a scenario's id. Throws EnvironmentError.
  CrowdTrace(const std::filesystem::path& path, const std::string& name,
             const crowd::Simulation& crowd, std::uint64_t seed);

  void record(const crowd::Simulation& crowd) override;
  void finish(const crowd::Simulation& crowd) override;

 private:
  world::TraceWriter trace_;
};

}  // namespace throng::sim
