// Output of one task: files of the dataset, and a record of them for the collecting task.
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

/// Indentation of the JSON files that people may open.
inline constexpr int kJsonIndent = 2;

/// A file of the dataset, as its manifest lists it.
struct FileEntry {
  std::string path;  ///< relative to the dataset, forward slashes
  std::int64_t bytes = 0;
  std::string sha256;
  std::optional<std::uint32_t> crc32 =
      std::nullopt;  ///< not there in what older versions published
};

void to_json(nlohmann::json& value, const FileEntry& file);
void from_json(const nlohmann::json& value, FileEntry& file);

/// Writes a file that nobody reads before the folder around it is published. Creates folders.
/// Throws EnvironmentError.
void write_new_file(const std::filesystem::path& path, std::string_view bytes);

/// Output under construction, in a staging folder: appears whole at publish(), or never.
///   files/...     the dataset's files, at their places in it
///   record.json   {"files": [...], "others": [...], and what the task has to say}
/// "others" are the files beside files/, with paths relative to the folder.
class Publication {
 public:
  explicit Publication(const std::filesystem::path& output);

  /// Adds a file of the dataset; hashes it from memory.
  void add(std::string path, std::string_view bytes);
  void publish(nlohmann::json record);
  /// For whatever else the task leaves behind.
  const std::filesystem::path& folder() const { return staging_.path(); }

 private:
  StagingFolder staging_;
  std::vector<FileEntry> files_;
};

/// Published output that is not as it was published: a file is gone, or has other bytes. Its task
/// has to be done again.
class DamagedOutput : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

/// The record of a published output. Throws DamagedOutput, and EnvironmentError when it cannot be
/// read.
nlohmann::json read_record(const std::filesystem::path& output);

/// Hashes all files of the output again. Throws as read_record().
void check_published(const std::filesystem::path& output, const nlohmann::json& record);

/// Path of a file of the dataset in published output.
std::filesystem::path published_file(const std::filesystem::path& output, const std::string& path);

}  // namespace throng::jobs
