// Recovery of the data folder when a server starts.
#pragma once

#include <cstdint>
#include <filesystem>

#include "jobs/queue/store/store.h"

namespace throng::server {

/// Folders of jobs and calibrations that the store knows nothing of are moved to DATA/quarantine,
/// never deleted: somebody may have put an older store back. Entries older than a month, and the
/// remains of half-finished uploads and removals, are removed. Throws EnvironmentError.
void tidy_data_folder(const std::filesystem::path& data, const jobs::Store& store);

/// Disk that everything in a folder takes; files with several names count once. 0 when there is
/// none.
std::int64_t measure_disk_bytes(const std::filesystem::path& folder);

}  // namespace throng::server
