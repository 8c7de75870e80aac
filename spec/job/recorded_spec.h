// The block "crowd.recorded" of a job: a trajectory file whose people are replayed instead of
// simulating a crowd.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "spec/job/field_table.h"
#include "spec/metrics/trajectory_format.h"

namespace throng::jobs {

/// A trajectory file, its format, and properties of its people.
struct RecordedSpec {
  std::filesystem::path file;  ///< path of the trajectory file
  std::string sha256;          ///< hash of its content (hex); "" until resolve() unless given
  metrics::TrajectoryFormat format;
  metrics::WalkerDefaults walkers;
};

/// The fields in the order of the schema.
const FieldTable<RecordedSpec>& recorded_fields();

/// Reads the block. The file's path is relative to the folder of the job's file; the file is not
/// opened. A job in a request body cannot name a file.
RecordedSpec read_recorded(const nlohmann::json& value, const FieldLocation& place);

/// The block as stored in a job's folder, where the file is `recorded/NAME`.
nlohmann::json to_json(const RecordedSpec& recorded);
/// Path of the copy of the recording in a job's folder.
std::filesystem::path kept_recording(const RecordedSpec& recorded,
                                     const std::filesystem::path& job_folder);

}  // namespace throng::jobs
