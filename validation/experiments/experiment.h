// The recorded laboratory experiments of a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spec/crowd/experiment.h"

namespace throng::validation {

/// Reads the experiments of a folder: those that its file experiments.json describes
/// (docs/validation.md), and other files whose names are those of experiments of the Pedestrian
/// Dynamics Data Archive (archive.h); with corridors of Hermes, also their diagram. Sorted by name.
/// Opens no recording. Throws InputError for a file that is wrong, for two experiments of the same
/// name, and if there is none.
std::vector<Experiment> find_experiments(const std::filesystem::path& folder);

/// Names of the folder's files that are no experiment by their name and that its experiments.json
/// does not describe, sorted.
std::vector<std::string> unread_files(const std::filesystem::path& folder,
                                      const std::vector<Experiment>& experiments);

}  // namespace throng::validation
