// Is a scenario fit for use? Everything that is wrong with it, each with what to do about it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "world/scenario.h"

namespace throng::scenarios {

enum class Severity {
  warning,  ///< works, but is probably not meant
  error     ///< a run would fail, or nobody could use its results
};

struct Finding {
  Severity severity = Severity::error;
  Problem problem;     ///< which file, which element, what was found, what was expected
  std::string remedy;  ///< what to do about it

  /// "error: yard.json: /exits/1: found ..., expected ...\n  remedy: ..."
  std::string text() const;
};

/// Checks a scenario and its crowd: sizes that only wrong units give; buildings that overlap;
/// people who start in walls, buildings or props or cannot get out; exits that nobody fits through,
/// that are walled up, that nobody reaches or heads for; gaps by which people get out without
/// passing an exit; drones in walls or in each other. `source`
/// names the scenario's file in the findings. Each error in its Menge files is a
/// finding, too. Throws EnvironmentError when one cannot be read.
std::vector<Finding> check(const world::Scenario& scenario, const std::string& source);

/// Those warnings of check() that concern its figures: who counts, and when. None for a scenario
/// that is unfit otherwise.
std::vector<Finding> check_figures(const world::Scenario& scenario, const std::string& source);

/// The same as check() for a scenario file, or for all scenarios below a folder; what cannot be
/// loaded is a finding. Throws InputError when there is no such file or folder, or no scenario in
/// it.
std::vector<Finding> check_files(const std::filesystem::path& file_or_folder);

/// Whether any of them is an error.
bool any_error(const std::vector<Finding>& findings);

}  // namespace throng::scenarios
