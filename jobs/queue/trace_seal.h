// The hash of a run's trace, beside it. A trace that was damaged since is made again; the library
// that reads it would crash at some damages.
#pragma once

#include <filesystem>
#include <string>

namespace throng::jobs {

/// Notes the hash of a trace that was just written. Throws EnvironmentError.
void seal_trace(const std::filesystem::path& trace);

/// SHA-256 of a trace in hex: the one that was noted, or without a seal that of the file. Throws
/// EnvironmentError.
std::string sealed_hash(const std::filesystem::path& trace);

/// Removes a trace that is no longer what it was when it was sealed; one without a seal is left
/// alone. Throws EnvironmentError.
void remove_if_damaged(const std::filesystem::path& trace);

}  // namespace throng::jobs
