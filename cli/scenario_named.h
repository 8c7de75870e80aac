// A scenario as a user names it.
#pragma once

#include <filesystem>
#include <string>

#include "cli/document_kind.h"
#include "cli/input_file.h"
#include "world/scenario.h"

namespace throng::cli {

/// A file where the name ends like one (.json), else the id of a shipped scenario. Throws
/// InputError.
inline world::Scenario scenario_named(const std::string& name) {
  const std::filesystem::path file(name);
  if (file.extension() != ".json") return world::find_scenario(world::scenarios_folder(), name);
  require_kind(DocumentKind::scenario, read_input_file(name, "a scenario file"), name);
  return world::load_scenario(file, file.stem().string());
}

}  // namespace throng::cli
