// The process of a live flight: simulates in real time, reads commands from stdin and writes
// messages (spec/live/messages.h) to stdout. The service starts one process per flight.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace throng::live {

/// How a flight is recorded.
struct RecordingOptions {
  std::uint64_t min_free_bytes = 0;  ///< the recording ends when the disk has less free space
  std::uint64_t max_bytes = 0;       ///< the recording ends at this size; 0: unlimited
};

/// Flies the first run of the job in `folder`/job.json until it is stopped, its stdin ends or
/// kMaxFlightS is over. Confines this process to the folder first. Each line of stdin is a JSON
/// object: {"commands": {...}} (spec/live/commands.h), {"viewers": N}, which pauses the simulation
/// while N is 0, or {"stop": true}. With `record`, the
/// flight is recorded in `folder`/kRecordingFile. Returns the exit code
/// (jobs/queue/workers/worker_protocol.h).
int run_session(const std::filesystem::path& folder, const std::optional<RecordingOptions>& record);

}  // namespace throng::live
