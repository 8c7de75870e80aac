// Backup of a service's data folder while the service runs, and its restoration. A backup is a
// folder:
//
//   BACKUP/data/         databases, jobs, calibrations, studies, uploads and the audit log
//   BACKUP/SHA256SUMS    hashes of all files in it, as sha256sum reads them
//   BACKUP/backup.json   format with its version, and the hash of SHA256SUMS; written last
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>

namespace throng::server {

/// Source and place of a backup.
struct BackupOptions {
  std::filesystem::path data;           ///< data folder of the service
  std::filesystem::path database = {};  ///< folder of its databases; "": `data`
  std::filesystem::path output;         ///< folder to be made
  bool with_datasets = true;            ///< false: without the jobs that have ended
};

/// Content of a backup.
struct BackupSize {
  std::int64_t files = 0;
  std::int64_t bytes = 0;
};

/// Receives the bytes done and in total.
using OnBackupBytes = std::function<void(std::int64_t done_bytes, std::int64_t total_bytes)>;

/// Makes a backup, whose folder appears once it is complete. Databases are copied as they are at
/// one moment, then files. Jobs that change meanwhile are queued in the backup, with what their
/// tasks have published. Throws InputError for wrong folders, EnvironmentError, and Cancelled.
BackupSize back_up(const BackupOptions& options, const OnBackupBytes& on_bytes,
                   const std::stop_token& stop);

/// Restores a backup to a new or empty folder, and its databases to `database` ("": `data`). All
/// names and hashes are checked before anything is written; a failed restoration leaves nothing.
/// Throws InputError for a damaged backup or a folder that is not empty, EnvironmentError, and
/// Cancelled.
BackupSize restore(const std::filesystem::path& backup, const std::filesystem::path& data,
                   const std::filesystem::path& database, const OnBackupBytes& on_bytes,
                   const std::stop_token& stop);

}  // namespace throng::server
