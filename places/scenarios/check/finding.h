// A finding about a scenario.
#pragma once

#include <string>

#include "base/error.h"

namespace throng::scenarios {

/// Severity of a finding.
enum class Severity {
  warning,  ///< works, but is probably not intended
  error     ///< a run would fail or have useless results
};

/// A problem of a scenario, with a remedy.
struct Finding {
  Severity severity = Severity::error;
  Problem problem;     ///< file, element, value found, value expected
  std::string remedy;  ///< what to do about it

  /// Text such as "error: yard.json: /exits/1: found ..., expected ...\n  remedy: ...".
  std::string text() const;
};

}  // namespace throng::scenarios
