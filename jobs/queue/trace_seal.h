// Seal of a run's trace: its SHA-256 in the file TRACE.sha256. A trace that no longer matches its
// seal is simulated again, because the HDF5 library can crash on damaged files.
#pragma once

#include <filesystem>
#include <string>

namespace throng::jobs {

/// Writes the seal of a trace that was just written. Throws EnvironmentError.
void seal_trace(const std::filesystem::path& trace);

/// SHA-256 of a trace in hex, read from its seal; without a seal, computed from the file. Throws
/// EnvironmentError.
std::string sealed_hash(const std::filesystem::path& trace);

/// Removes a trace without its seal, or with one that does not match. Throws EnvironmentError.
void remove_if_damaged(const std::filesystem::path& trace);

}  // namespace throng::jobs
