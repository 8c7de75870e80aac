// Errors of models over all experiments, with the criteria that they are held to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/experiments/comparison.h"

namespace throng::validation {

/// The difference of a model's mean from the recorded value, as a share of that; infinite for a
/// time that the model does not reach in each run, none if nothing was recorded.
std::optional<double> relative_error(const ComparedQuantity& quantity, std::size_t model);

/// Errors of one model.
struct ModelErrors {
  double mean = 0;  ///< of absolute values, as a share
  double max = 0;   ///< the greatest absolute value, as a share
  bool holds = false;
};

/// A quantity that is compared over all experiments, such as the flow.
struct Aspect {
  std::string title;
  double max_error = 0;                  ///< of each quantity
  std::optional<double> max_mean_error;  ///< of the mean over quantities
  std::size_t quantities = 0;
  std::vector<ModelErrors> models;  ///< in the order of Comparison::models
};

/// Returns the aspects exit flow, speed, T90 and diagram; those without a quantity are left out.
std::vector<Aspect> summarize(const Comparison& comparison);

}  // namespace throng::validation
