// The crowd engine's state in the form of a trace.
#pragma once

#include <filesystem>
#include <string>

#include "crowd/output/recorder.h"
#include "world/trace.h"

namespace throng::sim {

/// Constant data in the trace of a crowd: everybody is a person, there are no exits and no drones.
world::TraceHeader crowd_header(const crowd::Simulation& crowd, std::uint64_t seed);

/// The crowd as it is now; nobody heads for an exit.
world::CrowdStep crowd_step(const crowd::Simulation& crowd);

/// Writes the trace of a crowd without a scenario around it.
class CrowdTrace : public crowd::Recorder {
 public:
  /// `name` stands where other traces have the scenario. Throws EnvironmentError.
  CrowdTrace(const std::filesystem::path& path, const std::string& name,
             const crowd::Simulation& crowd, std::uint64_t seed);

  void record(const crowd::Simulation& crowd) override;
  void finish(const crowd::Simulation& crowd) override;

 private:
  world::TraceWriter trace_;
};

}  // namespace throng::sim
