// Names of files that are allowed and distinct on Linux, macOS and Windows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace throng {

/// Returns true for a name that Windows takes for a device, whatever its suffix: con, COM1,
/// nul.txt.
bool is_device_name(std::string_view name);

/// Describes what one of the systems does not allow in a relative path; nullopt if all allow it.
/// Letters beyond ASCII are not allowed: macOS may write them in another form.
std::optional<std::string> path_fault(std::string_view path);

/// A set of paths that differ in more than the case of their letters.
class DistinctPaths {
 public:
  /// A path that was added before and is the same on one of the systems.
  struct Clash {
    std::string earlier;
    bool is_equal;  ///< byte by byte
  };

  /// Adds a file or folder and the folders that contain it. Folders may be added again.
  std::optional<Clash> add(std::string_view path, bool is_folder = false);

  /// Number of folders, those that only contain others included.
  std::size_t folders() const { return folders_; }

 private:
  struct Known {
    std::string path;
    bool is_folder;
  };
  std::optional<Clash> add_one(const std::string& path, bool is_folder);

  std::unordered_map<std::string, Known> known_;  ///< by lower case
  std::string last_folder_;                       ///< of the last file, which need not be looked up
  std::size_t folders_ = 0;
};

}  // namespace throng
