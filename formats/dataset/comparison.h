// Comparison of recreated files with the existing ones.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace throng::formats {

/// Reports files below a folder that differ from the recreated ones, or that were not recreated.
class Comparison {
 public:
  using Report = std::function<void(const std::string& path, const std::string& what)>;

  /// `report` is called for each difference; paths are below `folder`.
  Comparison(std::filesystem::path folder, Report report)
      : folder_(std::move(folder)), report_(std::move(report)) {}

  /// Compares the file `path` with the recreated bytes.
  void bytes(const std::filesystem::path& path, std::string_view made);
  /// Compares the file `path` with the file at `made`, which may be the same file.
  void file(const std::filesystem::path& path, const std::filesystem::path& made);
  /// Reports the files that were not compared.
  void finish() const;

 private:
  bool is_there(const std::filesystem::path& path);

  std::filesystem::path folder_;
  Report report_;
  std::set<std::string> seen_;
};

/// A temporary folder for recreated files, removed with its content. The constructor throws
/// EnvironmentError.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace throng::formats
