// Restricts the files that a child process can access (Landlock, Linux 5.19): an attacker who takes
// over the parser of a mesh or an image can neither change other files nor read the service's keys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace throng::jobs {

/// Environment variable with the service's data folder. Children may read only the parts of it that
/// their FileFence names. Unset for `throng run`, which has nothing to hide.
inline constexpr const char* kPrivateFolderVariable = "THRONG_PRIVATE_FOLDER";
/// Environment variable with the folder of the service's databases, which may be the data folder.
/// It is hidden from children in the same way.
inline constexpr const char* kPrivateDatabaseVariable = "THRONG_PRIVATE_DATABASE";

/// Environment variable with the files that hold credentials of object stores, separated by colons.
/// Only the worker that publishes may read them and the files in ~/.aws.
inline constexpr const char* kPrivateCredentialsVariable = "THRONG_PRIVATE_CREDENTIALS";

/// Rules of access. Everything outside of `hidden` may be read.
struct FileFence {
  /// Files and folders that may be written, read and removed; nonexistent ones are ignored.
  std::vector<std::filesystem::path> writable;
  /// Files and folders that may not be read, except for the parts listed in the other members.
  std::vector<std::filesystem::path> hidden = {};
  /// Exceptions from `hidden`.
  std::vector<std::filesystem::path> readable;
};

/// Applies the fence to this process and its future children for the rest of their lives, whatever
/// the permissions of their user. Graphics devices, /dev/null and shared memory stay writable, open
/// descriptors stay usable. From Linux 6.12 on, signals reach only processes within the fence.
/// Returns why the kernel refuses, for people; "" on success.
std::string fence_this_process(const FileFence& fence);

/// Access to the credentials of object stores.
enum class Credentials { hidden, readable };

/// The fence of a child that works in `folder`, which is writable. Hidden are
/// $THRONG_PRIVATE_DATABASE, $THRONG_PRIVATE_FOLDER except for its folders scenarios and uploads,
/// and, with Credentials::hidden, the credentials.
FileFence fence_of_folder(const std::filesystem::path& folder,
                          Credentials credentials = Credentials::hidden);

/// Mesa's folder of compiled shaders, from $MESA_SHADER_CACHE_DIR, $XDG_CACHE_HOME or $HOME as its
/// documentation says; "" if none of them is set.
std::filesystem::path shader_cache_folder();

}  // namespace throng::jobs
