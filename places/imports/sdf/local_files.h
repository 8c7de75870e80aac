// Resolves the files to which a world refers, restricted to known folders of this machine.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace throng::imports {

/// The folders in which files are found.
class LocalFiles {
 public:
  explicit LocalFiles(const std::vector<std::filesystem::path>& folders);

  /// Finds the file of a URI (model://a/b, file://a, a/b), first in the folder of the file `from`,
  /// then in each of the folders. Nothing if it does not exist, is not below one of the folders, or
  /// is on another machine.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            const std::filesystem::path& from) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace throng::imports
