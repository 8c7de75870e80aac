// Checks a finished dataset against itself: every rule that its formats promise (docs/formats.md).
#pragma once

#include <filesystem>

#include "formats/validate/finding.h"

namespace throng::formats {

/// Reads all of the dataset once. Memory does not grow with its images, but for the lists of its
/// files and ids. Throws InputError when it is no finished dataset at all.
Validation validate_dataset(const std::filesystem::path& root);

}  // namespace throng::formats
