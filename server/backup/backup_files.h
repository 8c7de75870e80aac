// Files of a backup: their list, and copies of them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <stop_token>
#include <utility>

namespace throng::server {

inline constexpr const char* kBackupFormat = "throng backup 1";  ///< with its version
inline constexpr const char* kBackupNote = "backup.json";
inline constexpr const char* kBackupSums = "SHA256SUMS";
inline constexpr const char* kBackupData = "data";
/// Databases of a service, which starts with that of the jobs.
inline constexpr std::array kDatabases = {"keys.sqlite", "webhooks.sqlite", "jobs.sqlite"};

/// Copies files, also such as have several names, and counts bytes.
class FileCopier {
 public:
  /// Receives the bytes done and in total.
  using OnBytes = std::function<void(std::int64_t, std::int64_t)>;

  /// `total_bytes` is for progress only. The references must outlive this object.
  FileCopier(std::int64_t total_bytes, const OnBytes& on_bytes, const std::stop_token& stop)
      : total_bytes_(total_bytes), on_bytes_(on_bytes), stop_(stop) {}

  /// Copies a regular file that is not reached by a link below a folder that is not trusted. Files
  /// with the same inode as an earlier one become links to its copy. Returns false if there is no
  /// such file any more. Throws EnvironmentError and Cancelled.
  bool copy(const std::filesystem::path& from, const std::filesystem::path& to);
  /// Counts bytes that were not copied, such as those of a file that was hashed. Throws Cancelled.
  void count(std::int64_t bytes);

 private:
  std::int64_t total_bytes_;
  std::int64_t done_bytes_ = 0;
  const OnBytes& on_bytes_;
  const std::stop_token& stop_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::filesystem::path> copies_;
};

/// Whether a file or folder exists. Throws EnvironmentError if that cannot be seen.
bool is_there(const std::filesystem::path& path);

/// Throws InputError if one of the folders lies in the other.
void require_apart(const std::filesystem::path& one, const std::filesystem::path& other,
                   const char* option);

}  // namespace throng::server
