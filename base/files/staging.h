// Temporary paths of unfinished files and folders, and their renaming to final names. In a cluster,
// a process can stage in a folder of its own; once that folder is removed, the process can publish
// nothing more (fencing).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace throng {

/// Makes this process stage all files in `folder`, which must hold a file "claim" and be on the
/// file system of the final paths. Must be called before the process starts other threads. Throws
/// EnvironmentError.
void stage_in(const std::filesystem::path& folder);

/// Whether the folder of stage_in() or its file "claim" was removed, so that nothing can be
/// published any more.
bool is_staging_revoked();

/// Returns the paths published since stage_in(), in order. Thread-safe.
std::vector<std::filesystem::path> published_files();

/// Returns a new temporary path for `final_path`: PATH.tmp.HOST.PID.RANDOM.NUMBER beside it, or a
/// path with such a name in the folder of stage_in(). Unique among processes and hosts.
std::filesystem::path staging_path(const std::filesystem::path& final_path);

/// Whether a file or folder has a name that staging_path() makes.
bool is_staging_name(std::string_view name);

/// Renames a file or folder at a path of staging_path(). With stage_in(), the source is looked up
/// in the folder that was opened then: if that folder was removed, renaming fails even if a new
/// folder has the same path.
std::error_code publish_staged(const std::filesystem::path& staged,
                               const std::filesystem::path& final_path);

/// Links the staged file to its final path unless that exists; the file system decides which of
/// several processes succeeds.
std::error_code link_staged(const std::filesystem::path& staged,
                            const std::filesystem::path& final_path);

/// Returns the name of this machine in the cluster, e.g. "node7", or else its host name.
std::string name_of_this_host();

}  // namespace throng
