// `throng scenario import`: converts worlds of Gazebo and maps of OpenStreetMap to scenarios.
#pragma once

#include "cli/common/import_options.h"

namespace throng::cli {

/// Reads the world or map, adds people, and writes the scenario. Prints a summary to stdout and
/// elements that were left out to stderr. Throws InputError.
void import_scenario(const ImportOptions& options);

}  // namespace throng::cli
