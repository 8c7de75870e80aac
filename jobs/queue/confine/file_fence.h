// Restricts the files that a child process can access (Landlock, Linux 5.19): code that takes over
// the reader of a mesh or an image can neither change files of others nor read the service's keys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace throng::jobs {

/// The service's data folder, whose files children do not read but for what FileFence names. Unset
/// for `throng run`: there is nothing to hide.
inline constexpr const char* kPrivateFolderVariable = "THRONG_PRIVATE_FOLDER";
/// Likewise of its databases, where they lie elsewhere: children read nothing of it.
inline constexpr const char* kPrivateDatabaseVariable = "THRONG_PRIVATE_DATABASE";

/// Files with credentials of object stores, with colons between them: only the worker that
/// publishes reads them, and those in ~/.aws.
inline constexpr const char* kPrivateCredentialsVariable = "THRONG_PRIVATE_CREDENTIALS";

struct FileFence {
  /// Files and folders that may be written, read and removed; those that do not exist are left out.
  std::vector<std::filesystem::path> writable;
  /// Folders whose content may not be read, except for what is in `writable` and `readable`.
  std::vector<std::filesystem::path> hidden = {};
  std::vector<std::filesystem::path> readable;
};

/// From now on this process and its children write nothing outside of `writable`, whatever their
/// user may do; devices of graphics, /dev/null and shared memory are excepted. Since Linux 6.12
/// they send signals only to each other. Descriptors that are open stay usable. Returns why the
/// kernel does not allow it, for people; "" when it does.
std::string fence_this_process(const FileFence& fence);

/// Whether a child may read the credentials of object stores.
enum class Credentials { hidden, readable };

/// The fence of a child that works in a folder: it reads all but $THRONG_PRIVATE_FOLDER
/// and $THRONG_PRIVATE_DATABASE, of the former the scenarios, and credentials if it may.
FileFence fence_of_folder(const std::filesystem::path& folder,
                          Credentials credentials = Credentials::hidden);

/// Mesa's folder of compiled shaders, by its documentation; "" if it keeps none.
std::filesystem::path shader_cache_folder();

}  // namespace throng::jobs
