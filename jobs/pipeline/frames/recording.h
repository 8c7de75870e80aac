// Trajectory file of people who are replayed instead of simulated.
#pragma once

#include <vector>

#include "base/error.h"
#include "spec/job/recorded_spec.h"
#include "world/trace.h"

namespace throng::jobs {

/// Sets `recorded.sha256` to the file's hash, or to "" if there is no file. Adds a problem if the
/// file does not exist or its hash differs from the one in the job.
void identify_recording(RecordedSpec& recorded, std::vector<Problem>& problems);

/// Reads the people as a trace without states and intents. Throws InputError and EnvironmentError.
world::Trace read_recording(const RecordedSpec& recorded);

}  // namespace throng::jobs
