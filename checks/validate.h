// Checks a finished dataset for consistency, by the rules of docs/formats.md.
#pragma once

#include <filesystem>

#include "checks/finding.h"

namespace throng::checks {

/// Reads all files of the dataset once and returns the findings. Memory grows with the number of
/// images only by the lists of files and ids. Throws InputError if `root` is no finished dataset.
Validation validate_dataset(const std::filesystem::path& root);

}  // namespace throng::checks
