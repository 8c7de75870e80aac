// Reports of comparisons with recorded people: a Markdown page and JSON.
#pragma once

#include <string>

#include "validation/experiments/comparison.h"

namespace throng::validation {

/// Names of figures in a page, relative to it; empty: none.
struct Figures {
  std::string curves;   ///< of curves_plot()
  std::string diagram;  ///< of diagram_plot()
};

/// Returns a page: a table of errors and criteria, the figures, a table for each experiment.
std::string markdown(const Comparison& comparison, const Figures& figures = {});

/// Returns all values as a JSON document (docs/validation.md); values that are not reached or were
/// not measured are null.
std::string comparison_json(const Comparison& comparison);

}  // namespace throng::validation
