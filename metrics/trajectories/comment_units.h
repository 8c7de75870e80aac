// Units of positions that a comment states in its sentences.
#pragma once

#include <optional>
#include <string_view>

#include "metrics/trajectories/unit_words.h"

namespace throng::metrics {

/// The unit of positions that a comment states: "units: feet", "coordinates in inches", "x y [ft]",
/// "unit = 0.01 m". Units of other quantities ("heights in cm"), and "in" and "m" as other words,
/// do not count. A word behind "unit:" that is no unit is an unknown one.
std::optional<Unit> unit_in_comment(std::string_view comment);

}  // namespace throng::metrics
