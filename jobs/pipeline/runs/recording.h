// Trajectory file of people who are replayed instead of simulated.
#pragma once

#include <vector>

#include "base/error.h"
#include "spec/job/recorded_spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::jobs {

/// Sets `recorded.sha256` to the file's hash, or to "" if there is no file. Adds a problem if the
/// file does not exist or its hash differs from the one in the job.
void identify_recording(RecordedSpec& recorded, std::vector<Problem>& problems);

/// Reads the people as a trace without states and intents; `notes` receives the reader's warnings.
/// Throws InputError and EnvironmentError.
world::Trace read_recording(const RecordedSpec& recorded, std::vector<Problem>* notes = nullptr);

/// The reader's warnings and those about people in buildings, at /crowd/recorded/file.
std::vector<Problem> recording_warnings(std::vector<Problem> notes, const world::Trace& recording,
                                        const world::Scenario& scenario);

}  // namespace throng::jobs
