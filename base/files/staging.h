// Paths of files and folders until they get their final names, and the one place that renames
// them. A process of a cluster stages in a folder of its own: once that folder has been removed,
// nothing that the process wrote can be published any more, however late it tries (fencing).
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace throng {

/// From now on this process stages everything in this folder, which exists and is on the file
/// system of whatever is published. Throws EnvironmentError.
void stage_in(const std::filesystem::path& folder);

/// Whether the folder of stage_in() has been removed: nothing can be published any more.
bool is_staging_revoked();

/// Paths that have been published since stage_in(), in order. Safe to use from many threads.
std::vector<std::filesystem::path> published_files();

/// A new name for what is to become `final_path`: PATH.tmp.HOST.PID.RANDOM.NUMBER beside it, or
/// such a name in the folder of stage_in(). No other process gets it, on any host.
std::filesystem::path staging_path(const std::filesystem::path& final_path);

/// Renames what lies at a path of staging_path(). With stage_in() the source is looked up in the
/// folder that was opened then: if that was removed, renaming fails, even if a folder of the same
/// path has been made since.
std::error_code publish_staged(const std::filesystem::path& staged,
                               const std::filesystem::path& final_path);

/// Gives the staged file a second name unless that is taken; which of several processes succeeds is
/// up to the file system.
std::error_code link_staged(const std::filesystem::path& staged,
                            const std::filesystem::path& final_path);

/// "node7": the name that a cluster knows this machine by, else its host name.
std::string name_of_this_host();

}  // namespace throng
