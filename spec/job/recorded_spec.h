// The block "crowd.recorded" of a job: people of a trajectory file who are replayed instead of
// simulated.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "spec/job/field_table.h"
#include "spec/metrics/trajectory_format.h"

namespace throng::jobs {

struct RecordedSpec {
  std::filesystem::path file;  ///< where it lies
  std::string sha256;          ///< of its content, as hex; "" until resolve(), unless it is given
  metrics::TrajectoryFormat format;
  metrics::WalkerDefaults walkers;
};

/// In the order of the schema.
const FieldTable<RecordedSpec>& recorded_fields();

/// Reads the block. The file is named from the folder of the job's file, and is not opened; a job
/// without one (a request) can name none.
RecordedSpec read_recorded(const nlohmann::json& value, const FieldLocation& place);

/// The block as a job's folder has it: the file is `recorded/NAME` there.
nlohmann::json to_json(const RecordedSpec& recorded);
/// That file below a job's folder.
std::filesystem::path kept_recording(const RecordedSpec& recorded,
                                     const std::filesystem::path& job_folder);

}  // namespace throng::jobs
