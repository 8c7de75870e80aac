// The process of a live flight: it simulates in real time, takes commands from its stdin and writes
// messages (spec/live/messages.h) to its stdout. The service starts one per flight.
#pragma once

#include <filesystem>

namespace throng::live {

/// Flies the job in `folder`/job.json, whose first run it is, until it is asked to stop, the input
/// ends or the longest time is over. Confines this process to the folder first. Lines of the input
/// are JSON: {"commands": {...}} (spec/live/commands.h), {"viewers": N}: time stands still while
/// nobody looks, {"stop": true}. Returns the exit code (jobs/queue/workers/worker_protocol.h).
int run_session(const std::filesystem::path& folder);

}  // namespace throng::live
