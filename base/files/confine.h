// Keeping the names in somebody else's files inside a folder.
#pragma once

#include <filesystem>

namespace throng {

/// Whether a path leads into a folder, with every link on its path followed; also one where nothing
/// is.
bool lies_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// As long as it lives, the files that this thread's loaders read because a file names them
/// (scenarios, Menge's XML, meshes) must lie in the folder. It goes with the thread rather than
/// with every loader's parameters, so that no loader can be forgotten on the path.
class Confinement {
 public:
  explicit Confinement(const std::filesystem::path& folder);
  ~Confinement();
  Confinement(const Confinement&) = delete;
  Confinement& operator=(const Confinement&) = delete;

  /// Whether this thread may read a file that was named: always, where it is not confined.
  static bool allows(const std::filesystem::path& path);

 private:
  std::filesystem::path before_;
};

}  // namespace throng
