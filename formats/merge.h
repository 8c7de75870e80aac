// Several datasets as one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace throng::formats {

struct MergedCounts {
  std::int64_t runs = 0;
  std::int64_t images = 0;
  std::int64_t annotations = 0;
};

/// Makes one dataset of several, in their order: their runs are counted on, and so are the ids of
/// images, annotations and tracks; other files are hard links where the file system can. Splits
/// stay what they are. The job of the result says what all jobs say; their times, drones, kinds of
/// ground truth and classes must be equal. Formats below formats/ are left out: they are exported
/// again. Throws InputError, and EnvironmentError where the folder cannot be written; nothing is
/// left then.
MergedCounts merge_datasets(const std::vector<std::filesystem::path>& datasets,
                            const std::filesystem::path& output);

}  // namespace throng::formats
