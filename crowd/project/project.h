// Menge's project files: the scene, behavior, model and duration of a run.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "crowd/elements/attributes.h"
#include "crowd/output/scb.h"
#include "crowd/simulation.h"

namespace throng::crowd {

/// Parses one of kCompatWords. Throws InputError for other words.
Compat parse_compat(std::string_view word);
/// Parses one of kConstantsWords. Throws InputError for other words.
ConstantsChoice parse_constants(std::string_view word);
/// Parses one of kSeparationWords. Throws InputError for other words.
BodySeparation parse_separation(std::string_view separation);

/// Content of a project file.
struct Project {
  std::filesystem::path scene_file;  ///< empty if the file does not name it
  std::filesystem::path behavior_file;
  LoadOptions options;
  double duration_s = 400;             ///< max duration of the run
  std::filesystem::path output;        ///< trajectory file; empty: none
  std::string scb_version = "2.1";     ///< one of kScbVersions; for an output ending in .scb
  std::vector<Problem> warnings = {};  ///< ignored parts of the file
};

/// Replaces a seed of 0 by 1. Menge replaces it by the current time, which makes runs
/// irreproducible.
constexpr std::uint64_t seed_or_default(std::uint64_t seed) { return seed != 0 ? seed : 1; }

/// Returns the attributes of <Project>.
AttributeTable project_attributes();

/// Reads a project file; relative paths in it are resolved against its folder. Throws InputError
/// for invalid content or a missing file, EnvironmentError if the file cannot be read.
Project load_project(const std::filesystem::path& file);

/// Creates the simulation of a project. Throws like the constructor of Simulation, and InputError
/// if the scene or behavior file does not exist.
Simulation load_simulation(const Project& project);

}  // namespace throng::crowd
