// Figures of comparisons with recorded people: recorded ones are black, each model has a color.
#pragma once

#include <optional>

#include "base/graphics/drawing/drawing.h"
#include "validation/experiments/comparison.h"

namespace throng::validation {

/// Draws the number of people who have passed the line over time, a panel for each recording: of
/// models the median over seeds with a band from the first to the last. Nothing without recordings.
std::optional<drawing::Drawing> curves_plot(const Comparison& comparison);

/// Draws flow against density: points of closed corridors, those of models with their intervals.
/// Nothing without closed corridors.
std::optional<drawing::Drawing> diagram_plot(const Comparison& comparison);

}  // namespace throng::validation
