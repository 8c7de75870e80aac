// Messages without the paths of a machine's folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace throng {

/// Makes the paths of files in one of the folders relative to it: "/srv/data/jobs/x/job.json"
/// becomes "jobs/x/job.json" for the folder /srv/data.
std::string without_folders(std::string text, const std::vector<std::filesystem::path>& folders);

}  // namespace throng
