// manifest.json: what a dataset holds. Written last, so a dataset that has one is complete.
#pragma once

#include <filesystem>
#include <vector>

#include "jobs/queue/dataset/publication.h"

namespace throng::jobs {

inline constexpr const char* kManifestName = "manifest.json";

/// Raised when the meaning of a field of the manifest changes.
inline constexpr int kManifestVersion = 1;

struct Manifest {
  std::vector<FileEntry> files;  ///< of the dataset, sorted by path, without the manifest itself
  FileEntry itself;
};

/// Needs little more memory than its result, however many files there are. Throws EnvironmentError
/// when there is no manifest or it is damaged.
Manifest read_manifest(const std::filesystem::path& dataset);

}  // namespace throng::jobs
