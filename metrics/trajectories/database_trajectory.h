// Writing of JuPedSim's SQLite database.
#pragma once

#include <filesystem>
#include <string>

#include "world/trace.h"

namespace throng::metrics {

/// Writes the people of a trace and, unless it is empty, the walkable area (WKT), which is that of
/// all frames. Throws EnvironmentError.
void write_database(const world::Trace& trace, const std::string& walkable,
                    const std::filesystem::path& file);

}  // namespace throng::metrics
