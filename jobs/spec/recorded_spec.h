// The block "crowd.recorded" of a job: people of a trajectory file who are replayed instead of
// simulated.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "metrics/trajectory_file.h"
#include "world/trace.h"

namespace throng::jobs {

struct RecordedSpec {
  std::filesystem::path file;  ///< where it lies
  std::string sha256;          ///< of its content, as hex
  metrics::TrajectoryFormat format;
  metrics::WalkerDefaults walkers;
};

/// Reads the block, if it is there. The file is named from the folder of `source`, the job's file;
/// a job without one (a request) can name none. `sha256`, where given, must be the file's.
std::optional<RecordedSpec> read_recorded(const nlohmann::json& crowd, const std::string& source,
                                          std::vector<Problem>& problems);

/// The block as a job's folder has it: the file is `recorded/NAME` there, where keep_recording()
/// puts it.
nlohmann::json to_json(const RecordedSpec& recorded);
void keep_recording(const RecordedSpec& recorded, const std::filesystem::path& job_folder);

/// The people, as a trace without states and intents. Throws InputError and EnvironmentError.
world::Trace read_recording(const RecordedSpec& recorded);

}  // namespace throng::jobs
