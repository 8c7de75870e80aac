// Compares files that are made again with those that are there.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace throng::formats {

/// Says which files below a folder are not what is made again, and which are not made at all.
class Comparison {
 public:
  using Report = std::function<void(const std::string& path, const std::string& what)>;

  /// `report` is called for each difference; paths are below `folder`.
  Comparison(std::filesystem::path folder, Report report)
      : folder_(std::move(folder)), report_(std::move(report)) {}

  void bytes(const std::filesystem::path& path, std::string_view made);
  /// The file at `made` is to be that at `path`: the same one or one with equal bytes.
  void file(const std::filesystem::path& path, const std::filesystem::path& made);
  /// Reports the files that nothing was compared with.
  void finish() const;

 private:
  bool is_there(const std::filesystem::path& path);

  std::filesystem::path folder_;
  Report report_;
  std::set<std::string> seen_;
};

/// A folder for what is made again, removed with all that is in it. Throws EnvironmentError.
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
