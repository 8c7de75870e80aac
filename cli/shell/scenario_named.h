// Scenarios that a user names on the command line.
#pragma once

#include <filesystem>
#include <string>

#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "world/fields/trace_scenario.h"
#include "world/scenario.h"
#include "world/scenario_id.h"

namespace throng::cli {

/// Throws InputError for a missing file; suggests a scenario whose id the path ends with.
[[noreturn]] inline void refuse_missing_scenario(const std::string& name) {
  const auto id = world::scenario_id_in(world::scenarios_folder(), name);
  throw InputError({name, "", "no such file",
                    id ? "a scenario file, or its id: \"" + *id + '"' : "a scenario file"});
}

/// Loads a scenario from a file if the name ends with .json, otherwise the shipped scenario with
/// this id. Throws InputError.
inline world::Scenario scenario_named(const std::string& name) {
  const std::filesystem::path file(name);
  if (file.extension() != ".json") return scenarios::find_scenario(world::scenarios_folder(), name);
  if (!std::filesystem::exists(file)) refuse_missing_scenario(name);
  require_scenario(read_input_file(name, "a scenario file"), name);
  return scenarios::load_scenario(file, world::id_from_file(file));
}

/// The scenario that the user names. If `name` is "", the scenario stored in the trace, or else the
/// shipped one with the trace's scenario id. Throws InputError.
inline world::Scenario scenario_of_trace(const std::string& name, const world::TraceHeader& header,
                                         const std::string& file) {
  if (!name.empty()) return scenario_named(name);
  auto kept = world::scenario_in_trace(header, file, world::TraceMeshes::left_out);
  return kept ? *std::move(kept) : scenario_named(header.scenario_id);
}

}  // namespace throng::cli
