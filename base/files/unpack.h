// Unpacking an archive that came from somebody else: nothing of it lands outside the folder, and
// it cannot grow beyond what was agreed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace throng {

/// Limits on an archive's contents.
struct UnpackLimits {
  std::size_t max_entries = 4000;
  std::int64_t max_file_bytes = 256LL << 20U;  ///< of each file
  std::int64_t max_bytes = 1LL << 30U;         ///< of all files together
  /// Unpacked bytes per packed byte; text and empty images reach some dozens.
  std::int64_t max_ratio = 200;
  std::size_t max_path_bytes = 200;  ///< characters
  std::size_t max_depth = 8;         ///< folders and the file's name
};

struct Unpacked {
  std::size_t files = 0;
  std::int64_t bytes = 0;
};

/// Unpacks a zip, tar or tar.gz file, recognized by its first bytes, into an empty folder. Names
/// are relative paths of printable ASCII that any system could hold; files and folders only: no
/// links, no devices; nothing encrypted; no two names that differ in their case alone. Files that
/// macOS adds to zip files (__MACOSX, .DS_Store) are skipped. Throws InputError naming the entry
/// and EnvironmentError; the folder then holds a part.
Unpacked unpack_archive(std::string_view bytes, const std::filesystem::path& folder,
                        const UnpackLimits& limits = {});

}  // namespace throng
