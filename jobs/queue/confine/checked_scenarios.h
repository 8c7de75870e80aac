// Result of a check of uploaded scenarios.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// Something that stops nobody from using the scenarios.
struct ScenarioFinding {
  bool is_error = false;  ///< else a warning
  Problem problem;
  std::string remedy;
};

struct CheckedScenarios {
  std::vector<std::string> ids;                ///< below the folder
  std::vector<ScenarioFinding> findings = {};  ///< of all
  /// Summary of each for clients (spec/scenarios/scenario_summary.h), in the order of the ids.
  std::vector<nlohmann::json> summaries = {};
};

void to_json(nlohmann::json& value, const CheckedScenarios& checked);
void from_json(const nlohmann::json& value, CheckedScenarios& checked);

}  // namespace throng::jobs
