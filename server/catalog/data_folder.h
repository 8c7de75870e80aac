// Recovery of the data folder when a server starts.
#pragma once

#include <cstdint>
#include <filesystem>

#include "jobs/queue/store/store.h"

namespace throng::server {

/// Moves folders of jobs and calibrations that are not in the store to DATA/quarantine, because an
/// older store may have been restored. Removes entries of the quarantine older than a month and the
/// remains of interrupted uploads and removals. Throws EnvironmentError.
void tidy_data_folder(const std::filesystem::path& data, const jobs::Store& store);

/// Disk usage of a folder in bytes; files with several hard links count once. 0 if there is no
/// folder.
std::int64_t measure_disk_bytes(const std::filesystem::path& folder);

}  // namespace throng::server
