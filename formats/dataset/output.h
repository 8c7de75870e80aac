// The output of an exporter: files below one folder, which nobody reads before all of it is there.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace throng::formats {

class Comparison;

/// A text that is written front to back.
class OutputStream {
 public:
  /// Creates the folder around it. Throws EnvironmentError, as all of these do, when the disk
  /// refuses.
  explicit OutputStream(std::filesystem::path path);
  /// The same, to be held against the file at `compared`, and removed, when it is closed.
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

class Output {
 public:
  /// With a comparison, nothing stays in the folder: all is held against what is there already.
  explicit Output(std::filesystem::path folder, Comparison* comparison = nullptr)
      : folder_(std::move(folder)), comparison_(comparison) {}

  const std::filesystem::path& folder() const { return folder_; }
  void write(const std::filesystem::path& path, std::string_view bytes) const;
  OutputStream open(const std::filesystem::path& path) const {
    return {folder_ / path, comparison_, path};
  }
  /// To be called for a file that was written without a stream, below folder(), and is closed.
  void written(const std::filesystem::path& path) const;
  /// The same file under another name: a hard link, or a copy where links do not work.
  void link(const std::filesystem::path& path, const std::filesystem::path& source) const;

 private:
  std::filesystem::path folder_;
  Comparison* comparison_;
};

}  // namespace throng::formats
