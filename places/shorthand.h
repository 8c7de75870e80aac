// Abbreviations of blueprints for parts of a scenario file: boxes for outlines, rows of props.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::places {

/// Replaces "box": [x0, y0, x1, y1] by the outline that stands for ("footprint" of buildings,
/// "corners" of ground areas, "area" of scatter and groups of people), and "rows" by props. Adds
/// to `problems` what cannot be read.
void expand_shorthand(nlohmann::json& blueprint, const std::string& source,
                      std::vector<Problem>& problems);

}  // namespace throng::places
