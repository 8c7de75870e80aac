// manifest.json: the list of a dataset's files. It is written last, so a dataset with a manifest is
// complete.
#pragma once

#include <filesystem>
#include <vector>

#include "jobs/queue/dataset/publication.h"

namespace throng::jobs {

inline constexpr const char* kManifestName = "manifest.json";

/// Incremented when the meaning of a field of the manifest changes.
inline constexpr int kManifestVersion = 1;

/// A manifest that was read.
struct Manifest {
  std::vector<FileEntry> files;  ///< of the dataset, sorted by path, without the manifest
  FileEntry itself;              ///< entry of the manifest file
};

/// Reads the manifest of a dataset with little more memory than the result needs. Throws
/// EnvironmentError if the manifest is missing or damaged, and InputError if it names a file that
/// is not below the dataset's folder.
Manifest read_manifest(const std::filesystem::path& dataset);

}  // namespace throng::jobs
