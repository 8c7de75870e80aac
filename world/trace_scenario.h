// The scenario that a trace holds, so that a trace is enough to measure and to render its run.
#pragma once

#include <optional>
#include <string>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::world {

/// Meshes of a scenario are files of their own, which a trace does not hold.
enum class TraceMeshes {
  left_out,  ///< the scenario without them: for figures
  needed     ///< no scenario if it has some: for images
};

/// The scenario of the trace's run without its crowd; nothing in traces of earlier versions.
/// `source` is the trace's file, for messages. Throws InputError for a damaged one.
std::optional<Scenario> scenario_in_trace(const TraceHeader& header, const std::string& source,
                                          TraceMeshes meshes);

}  // namespace throng::world
