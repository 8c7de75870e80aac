// The trajectory file of people who are replayed instead of simulated.
#pragma once

#include <vector>

#include "base/error.h"
#include "spec/job/recorded_spec.h"
#include "world/trace.h"

namespace throng::jobs {

/// Fills in the file's hash, or adds to `problems` that there is no such file or that it is not the
/// one whose hash the job gives; without a file the hash is "".
void identify_recording(RecordedSpec& recorded, std::vector<Problem>& problems);

/// The people, as a trace without states and intents. Throws InputError and EnvironmentError.
world::Trace read_recording(const RecordedSpec& recorded);

}  // namespace throng::jobs
