// Files that a world refers to, on this machine and below known folders only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace throng::imports {

class LocalFiles {
 public:
  explicit LocalFiles(const std::vector<std::filesystem::path>& folders);

  /// The file that a URI names (model://a/b, file://a, a/b), first beside `from`, a file, then in
  /// each folder; nothing where it is not there, not below one of the folders or on another
  /// machine.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            const std::filesystem::path& from) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace throng::imports
