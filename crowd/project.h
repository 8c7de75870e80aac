// A Menge project file: which scene and behavior are run, with which model, for how long.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "crowd/elements/attributes.h"
#include "crowd/output/scb.h"
#include "crowd/simulation.h"

namespace throng::crowd {

/// Throws InputError for a word that is not in kCompatWords.
Compat parse_compat(std::string_view word);
/// Throws InputError for a word that is not in kSeparationWords.
bool is_hard(std::string_view separation);

struct Project {
  std::filesystem::path scene_file;  ///< empty when it is not given
  std::filesystem::path behavior_file;
  LoadOptions options;
  double duration_s = 400;             ///< no longer than this
  std::filesystem::path output;        ///< trajectories, empty: none
  std::string scb_version = "2.1";     ///< of an .scb output, one of kScbVersions
  std::vector<Problem> warnings = {};  ///< what was ignored
};

/// Menge takes the clock for a seed of 0; here that is 1, so that every run can be repeated.
constexpr std::uint64_t seed_or_default(std::uint64_t seed) { return seed != 0 ? seed : 1; }

/// The attributes of <Project>.
AttributeTable project_attributes();

/// Reads a <Project>. Paths in it are relative to its folder. Throws InputError, also when there
/// is no such file, EnvironmentError when it cannot be read.
Project load_project(const std::filesystem::path& file);

/// The simulation that the project describes. Throws InputError and EnvironmentError like
/// Simulation's constructor, and InputError when there is no such file.
Simulation load_simulation(const Project& project);

}  // namespace throng::crowd
