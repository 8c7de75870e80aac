// Result of a check of uploaded scenarios, passed as JSON from the confined task to the server.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// A finding that does not prevent the use of the scenarios.
struct ScenarioFinding {
  bool is_error = false;  ///< false: a warning
  Problem problem;
  std::string remedy;  ///< how to fix it
};

/// The scenarios of one upload.
struct CheckedScenarios {
  std::vector<std::string> ids;                ///< relative to the uploaded folder
  std::vector<ScenarioFinding> findings = {};  ///< over all scenarios
  /// Summary of each scenario for clients (spec/scenarios/scenario_summary.h), in the order of
  /// `ids`.
  std::vector<nlohmann::json> summaries = {};
};

void to_json(nlohmann::json& value, const CheckedScenarios& checked);
void from_json(const nlohmann::json& value, CheckedScenarios& checked);

}  // namespace throng::jobs
