// Merges several datasets into one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace throng::formats {

/// Size of the merged dataset.
struct MergedCounts {
  std::int64_t runs = 0;
  std::int64_t images = 0;
  std::int64_t annotations = 0;
};

/// Merges datasets in the given order into the new folder `output`. Runs are renumbered
/// consecutively, and so are the ids of images, annotations and tracks; other files are hard links
/// if the file system supports them. Splits are kept. The job of the result has the members on
/// which all jobs agree; their times, drones, kinds of ground truth and classes must be equal.
/// Exports below formats/ are left out. Throws InputError, and EnvironmentError if the folder
/// cannot be written; `output` then does not exist.
MergedCounts merge_datasets(const std::vector<std::filesystem::path>& datasets,
                            const std::filesystem::path& output);

}  // namespace throng::formats
