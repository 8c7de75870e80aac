// Worlds and maps of others as scenarios: the work of `throng scenario import`.
#pragma once

#include "cli/common/import_options.h"

namespace throng::cli {

/// Reads the world or map, gives it people, and writes the scenario; reports on stdout, and what
/// was left out on stderr. Throws InputError.
void import_scenario(const ImportOptions& options);

}  // namespace throng::cli
