// The scenario stored in a trace, with which a run can be measured and rendered without other
// files.
#pragma once

#include <optional>
#include <string>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::world {

/// Treatment of a scenario's meshes, which are separate files that a trace does not hold.
enum class TraceMeshes {
  left_out,  ///< returns the scenario without its meshes (for measures)
  needed     ///< returns nothing if the scenario has meshes (for rendering)
};

/// Returns the scenario of the run without its crowd; nothing for traces of earlier versions.
/// `source` names the trace in messages. Throws InputError if the stored scenario is invalid.
std::optional<Scenario> scenario_in_trace(const TraceHeader& header, const std::string& source,
                                          TraceMeshes meshes);

}  // namespace throng::world
