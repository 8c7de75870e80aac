// Comparison of pedestrian models with recorded people: values with error bands, and N-t curves.
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "validation/experiments/replay.h"

namespace throng::validation {

/// The values of one quantity over the seeds of a model.
struct Sample {
  std::vector<double> values;

  double mean() const;
  /// Half of the width of the 95 % interval of the mean (Student's t); 0 for one value.
  double half_interval() const;
};

/// A quantity of an experiment: recorded and simulated.
struct ComparedQuantity {
  std::string name;
  std::string unit;
  double recorded = 0;
  double at_density = 0;       ///< 1/m^2, of a point of a diagram; else 0
  std::vector<Sample> models;  ///< in the order of Comparison::models
};

/// The results for one experiment.
struct ComparedExperiment {
  std::string name;
  std::size_t people = 0;  ///< of a recording; 0 for closed corridors
  std::vector<ComparedQuantity> quantities;
  std::vector<double> recorded_passages_s;
  std::vector<std::vector<std::vector<double>>> passages_s;  ///< by model, then by seed
  std::vector<Sample> curve_differences;  ///< of N-t curves, as shares; empty for closed corridors
};

struct Comparison {
  std::vector<std::string> models;
  std::size_t seeds = 0;
  std::vector<ComparedExperiment> experiments;
};

/// Called with the number of finished simulations and their total; one call at a time.
using ComparisonProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Simulates each experiment with each model and the seeds 1 to `seeds` on `threads` threads, on
/// which results do not depend. Throws InputError and EnvironmentError for recordings that cannot
/// be read, Cancelled when `stop` is requested.
Comparison compare(const std::vector<Experiment>& experiments, const std::vector<Tested>& models,
                   std::size_t seeds, int threads, const ComparisonProgress& progress = {},
                   const std::stop_token& stop = {});

}  // namespace throng::validation
