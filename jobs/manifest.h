// manifest.json: what a dataset holds. Written last, so a dataset that has one is complete.
#pragma once

#include <filesystem>
#include <vector>

#include "jobs/publication.h"

namespace throng::jobs {

inline constexpr const char* kManifestName = "manifest.json";

/// Raised when the meaning of a field of the manifest changes.
inline constexpr int kManifestVersion = 1;

/// The files of a dataset, sorted by path; the manifest itself is not among them. Throws
/// EnvironmentError when there is no manifest or it is damaged.
std::vector<FileEntry> read_manifest_files(const std::filesystem::path& dataset);

}  // namespace throng::jobs
