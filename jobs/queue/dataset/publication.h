// Output of one task: files of the dataset, and a record of them for the task that collects it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::jobs {

/// Indentation of JSON files that people read.
inline constexpr int kJsonIndent = 2;

/// A file of the dataset, as its manifest lists it.
struct FileEntry {
  std::string path;  ///< relative to the dataset, forward slashes
  std::int64_t bytes = 0;
  std::string sha256;
  std::optional<std::uint32_t> crc32 =
      std::nullopt;  ///< missing in output that an older version has published
};

void to_json(nlohmann::json& value, const FileEntry& file);
void from_json(const nlohmann::json& value, FileEntry& file);

/// Writes a file directly, without a temporary name: for folders that are not yet published.
/// Creates the folders of the path. Throws EnvironmentError.
void write_new_file(const std::filesystem::path& path, std::string_view bytes);

/// Output under construction in a staging folder; it appears whole at publish(), or never.
///   files/...     files of the dataset, at their paths in it
///   record.json   {"files": [...], "others": [...], and the members of the task's record}
/// "others" are the files outside of files/, with paths relative to the folder.
class Publication {
 public:
  explicit Publication(const std::filesystem::path& output);

  /// Writes a file of the dataset and adds its hashes to the record. Throws EnvironmentError.
  void add(std::string path, std::string_view bytes);
  /// Writes record.json, with "files" and "others" added to `record`, and moves the folder to its
  /// final path. Throws EnvironmentError.
  void publish(nlohmann::json record);
  /// The staging folder, for other files of the task.
  const std::filesystem::path& folder() const { return staging_.path(); }

 private:
  StagingFolder staging_;
  std::vector<FileEntry> files_;
};

/// Thrown for published output that has changed: a file is missing or has other bytes. The task has
/// to be repeated.
class DamagedOutput : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

/// The record of a published output. Throws DamagedOutput, and EnvironmentError when it cannot be
/// read.
nlohmann::json read_record(const std::filesystem::path& output);

/// Hashes all files of the output again. Throws as read_record().
void check_published(const std::filesystem::path& output, const nlohmann::json& record);

/// Path of the file with `path` in the dataset within the published output of a task.
std::filesystem::path published_file(const std::filesystem::path& output, const std::string& path);

}  // namespace throng::jobs
