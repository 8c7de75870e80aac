// Abbreviations of blueprints for parts of a scenario file: boxes for outlines, rows of props.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace throng::scenarios {

/// A blueprint without abbreviations, and where its parts come from.
struct Expanded {
  nlohmann::json blueprint;
  /// Pointers of parts that an abbreviation stands for, and of the abbreviation.
  std::vector<std::pair<std::string, std::string>> origins;

  /// The problems with pointers into the blueprint as it was said, each once.
  std::vector<Problem> as_said(std::vector<Problem> problems, const nlohmann::json& said) const;
};

/// Replaces "box": [x0, y0, x1, y1] by the outline that stands for ("footprint" of buildings,
/// "corners" of ground areas, "area" of scatter and groups of people), and "rows" by props. Throws
/// InputError.
Expanded expand_shorthand(const nlohmann::json& said, const std::string& source);

}  // namespace throng::scenarios
