#include "validation/experiments/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace throng::validation {

namespace {

constexpr double kMaxError = 0.15;
constexpr double kMaxMeanError = 0.08;
constexpr double kMaxTimeError = 0.12;

bool is_point(const ComparedQuantity& quantity) { return quantity.at_density > 0; }

bool is_exit_flow(const ComparedQuantity& quantity) {
  return !is_point(quantity) && quantity.name.starts_with("flow");
}

bool is_speed(const ComparedQuantity& quantity) { return quantity.name == "speed"; }

bool is_time(const ComparedQuantity& quantity) { return quantity.name == "T90"; }

struct Kind {
  const char* title;
  bool (*includes)(const ComparedQuantity&);
  double max_error;
  std::optional<double> max_mean_error;
};

const std::array<Kind, 4> kKinds = {{{"exit flow", is_exit_flow, kMaxError, kMaxMeanError},
                                     {"speed", is_speed, kMaxError, kMaxMeanError},
                                     {"T90", is_time, kMaxTimeError, {}},
                                     {"diagram", is_point, kMaxError, kMaxMeanError}}};

ModelErrors errors_of_model(const std::vector<double>& errors, const Kind& kind) {
  ModelErrors result;
  for (const double error : errors) {
    result.max = std::max(result.max, error);
    result.mean += error / static_cast<double>(errors.size());
  }
  result.holds =
      result.max <= kind.max_error && (!kind.max_mean_error || result.mean <= *kind.max_mean_error);
  return result;
}

}  // namespace

std::optional<double> relative_error(const ComparedQuantity& quantity, std::size_t model) {
  if (!std::isfinite(quantity.recorded) || quantity.recorded == 0) return std::nullopt;
  const double mean = quantity.models[model].mean();
  // Nobody came: as wrong as a time that is not reached.
  if (!std::isfinite(mean)) return std::numeric_limits<double>::infinity();
  return mean / quantity.recorded - 1;
}

std::vector<Aspect> summarize(const Comparison& comparison) {
  std::vector<Aspect> aspects;
  for (const Kind& kind : kKinds) {
    Aspect aspect{kind.title, kind.max_error, kind.max_mean_error, 0, {}};
    for (std::size_t model = 0; model < comparison.models.size(); ++model) {
      std::vector<double> errors;
      for (const ComparedExperiment& experiment : comparison.experiments) {
        for (const ComparedQuantity& quantity : experiment.quantities) {
          if (!kind.includes(quantity)) continue;
          if (const auto error = relative_error(quantity, model))
            errors.push_back(std::abs(*error));
        }
      }
      aspect.quantities = errors.size();
      aspect.models.push_back(errors_of_model(errors, kind));
    }
    if (aspect.quantities > 0) aspects.push_back(std::move(aspect));
  }
  return aspects;
}

}  // namespace throng::validation
