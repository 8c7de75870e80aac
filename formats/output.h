// Where an exporter writes: files below one folder, which nobody reads before all of it is there.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace throng::formats {

/// A text that is written front to back.
class OutputStream {
 public:
  /// Creates the folder around it. Throws EnvironmentError, as all of these do, when the disk
  /// refuses.
  explicit OutputStream(std::filesystem::path path);
  void write(std::string_view text);
  void close();

 private:
  void require_good() const;
  std::filesystem::path path_;
  std::ofstream file_;
};

class Output {
 public:
  explicit Output(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }
  void write(const std::filesystem::path& path, std::string_view bytes) const;
  OutputStream open(const std::filesystem::path& path) const {
    return OutputStream(folder_ / path);
  }
  /// The same file under another name: a hard link, or a copy where links do not work.
  void link(const std::filesystem::path& path, const std::filesystem::path& source) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace throng::formats
