// Folders that are still there after a power failure.
#pragma once

#include <filesystem>

namespace throng {

/// Creates the folder and those around it. Nothing if it exists. Throws EnvironmentError.
void make_folders(const std::filesystem::path& folder);

}  // namespace throng
