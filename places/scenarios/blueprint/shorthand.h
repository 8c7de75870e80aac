// Abbreviations of blueprints for parts of a scenario file: boxes for outlines, rows of props.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace throng::scenarios {

/// A blueprint without abbreviations, and the origins of its parts.
struct Expanded {
  nlohmann::json blueprint;
  /// Pairs of JSON pointers: of an expanded part, and of its abbreviation.
  std::vector<std::pair<std::string, std::string>> origins;

  /// The problems with JSON pointers into the original blueprint `said`, without duplicates.
  std::vector<Problem> as_said(std::vector<Problem> problems, const nlohmann::json& said) const;
};

/// Replaces "box": [x0, y0, x1, y1] by the corresponding outline ("footprint" of buildings,
/// "corners" of ground areas, "area" of scatter and groups of people), and "rows" by props. Throws
/// InputError naming `source`.
Expanded expand_shorthand(const nlohmann::json& said, const std::string& source);

}  // namespace throng::scenarios
