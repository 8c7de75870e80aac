// Unpacking of untrusted archives: no entry is written outside the folder, and the content is
// limited.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace throng {

/// Limits on the content of an archive.
struct UnpackLimits {
  std::size_t max_entries = 4000;
  std::int64_t max_file_bytes = 256LL << 20U;  ///< per file
  std::int64_t max_bytes = 1LL << 30U;         ///< sum of all files
  /// Ratio of unpacked to packed bytes; text and empty images reach several dozens.
  std::int64_t max_ratio = 200;
  std::size_t max_path_bytes = 200;  ///< length of an entry's path
  std::size_t max_depth = 8;         ///< components of an entry's path
  std::size_t max_folders = 1000;    ///< folders of all entries together
};

void to_json(nlohmann::json& value, const UnpackLimits& limits);
void from_json(const nlohmann::json& value, UnpackLimits& limits);

/// Number and total size of unpacked files.
struct Unpacked {
  std::size_t files = 0;
  std::int64_t bytes = 0;
};

/// Unpacks a zip, tar or tar.gz file, recognized by its first bytes, into an empty folder. Accepts
/// files and folders with relative paths of printable ASCII that are valid on all systems; no
/// links, devices, encrypted entries, or names that differ only in case. Skips files that macOS
/// adds (__MACOSX, .DS_Store). Throws InputError with the name of the entry, and EnvironmentError;
/// the folder then holds a part of the files.
Unpacked unpack_archive(std::string_view bytes, const std::filesystem::path& folder,
                        const UnpackLimits& limits = {});

/// Copies what a process that is not trusted has unpacked from a folder that is not trusted
/// (base/files/untrusted_folders.h) into an empty one, by the rules of unpack_archive() except
/// max_ratio. Throws InputError with the name of the file, and EnvironmentError.
Unpacked copy_unpacked(const std::filesystem::path& from, const std::filesystem::path& to,
                       const UnpackLimits& limits = {});

}  // namespace throng
