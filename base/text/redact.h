// Messages for people who need not know how a machine's disks are laid out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace throng {

/// The text with every file in one of the folders named from there: "/srv/data/jobs/x/job.json"
/// becomes "jobs/x/job.json" where /srv/data is one of them.
std::string without_folders(std::string text, const std::vector<std::filesystem::path>& folders);

}  // namespace throng
