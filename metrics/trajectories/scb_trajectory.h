// Writing of Menge's trajectories.
#pragma once

#include <filesystem>

#include "world/trace.h"

namespace throng::metrics {

/// Writes the people of a trace as .scb 2.1, with class 0. Throws EnvironmentError.
void write_scb(const world::Trace& trace, const std::filesystem::path& file);

}  // namespace throng::metrics
