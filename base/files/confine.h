// Restriction of file names in untrusted files to a folder.
#pragma once

#include <filesystem>

namespace throng {

/// Whether a path, with all links resolved, is in a folder. The path need not exist.
bool lies_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// During its lifetime, files that a loader on this thread reads because another file names them
/// (scenarios, Menge's XML, meshes) must be in the folder. A property of the thread and not a
/// parameter of the loaders, so that no loader can omit it. Objects nest: the destructor restores
/// the state before.
class Confinement {
 public:
  explicit Confinement(const std::filesystem::path& folder);
  ~Confinement();
  Confinement(const Confinement&) = delete;
  Confinement& operator=(const Confinement&) = delete;

  /// Whether this thread may read a named file; true if the thread is not confined.
  static bool allows(const std::filesystem::path& path);

 private:
  std::filesystem::path before_;
};

}  // namespace throng
