// The findings of checks, as texts.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "checks/findings.h"

namespace throng::checks {

/// Findings of checks as "rule record what".
inline std::vector<std::string> found_by(const std::function<void(Findings&)>& check) {
  Validation validation;
  Findings findings(validation);
  check(findings);
  std::vector<std::string> found;
  for (const Finding& finding : validation.findings) {
    found.push_back(finding.rule + " " + finding.record + " " + finding.what);
  }
  return found;
}

}  // namespace throng::checks
