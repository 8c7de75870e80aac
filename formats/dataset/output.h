// Output of an exporter: files below one folder, which is published as a whole.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace throng::formats {

class Comparison;

/// A file that is written sequentially. All members throw EnvironmentError if it cannot be written.
class OutputStream {
 public:
  /// Creates the file and its folder.
  explicit OutputStream(std::filesystem::path path);
  /// Creates a file that close() compares with the file `compared` and then removes.
  OutputStream(std::filesystem::path path, Comparison* comparison, std::filesystem::path compared);
  void write(std::string_view text);
  void close();

 private:
  void require_good() const;
  std::filesystem::path path_;
  std::ofstream file_;
  Comparison* comparison_ = nullptr;
  std::filesystem::path compared_;
};

/// Writes files below a folder, or compares them with existing files. All members throw
/// EnvironmentError, and InputError for a path that leads out of the folder.
class Output {
 public:
  /// With a comparison, no file stays in the folder: all are compared with the existing files.
  explicit Output(std::filesystem::path folder, Comparison* comparison = nullptr)
      : folder_(std::move(folder)), comparison_(comparison) {}

  const std::filesystem::path& folder() const { return folder_; }
  void write(const std::filesystem::path& path, std::string_view bytes) const;
  OutputStream open(const std::filesystem::path& path) const;
  /// Call it after a file below folder() was written without OutputStream and closed.
  void written(const std::filesystem::path& path) const;
  /// Adds `source` under the name `path`: as a hard link, or as a copy if links do not work.
  void link(const std::filesystem::path& path, const std::filesystem::path& source) const;

 private:
  std::filesystem::path folder_;
  Comparison* comparison_;
};

}  // namespace throng::formats
