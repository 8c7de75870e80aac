#include "validation/experiments/report.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text/words.h"
#include "validation/experiments/summary.h"

namespace throng::validation {

using nlohmann::ordered_json;

namespace {

constexpr double kPercent = 100;

/// Three digits or so.
std::string number_text(double value) {
  const double size = std::abs(value);
  if (size >= 100) return fmt::format("{:.0f}", value);
  if (size >= 10) return fmt::format("{:.1f}", value);
  return size >= 0.1 ? fmt::format("{:.2f}", value) : fmt::format("{:.3f}", value);
}

std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.0f} %", kPercent * share) : "∞";
}

std::string recorded_text(double value) {
  if (std::isnan(value)) return "not measured";
  return std::isfinite(value) ? number_text(value) : "not reached";
}

std::string interval_text(const Sample& sample) {
  if (sample.values.size() < 2) return "";
  return fmt::format(" ± {}", number_text(sample.half_interval()));
}

std::string model_text(const ComparedQuantity& quantity, std::size_t model) {
  const Sample& sample = quantity.models[model];
  if (!std::isfinite(sample.mean())) return recorded_text(sample.mean());
  std::string text = number_text(sample.mean()) + interval_text(sample);
  if (const auto error = relative_error(quantity, model)) {
    text += fmt::format(" ({:+.0f} %)", std::round(kPercent * *error) + 0.0);  // no -0
  }
  return text;
}

std::string head_text(const std::string& first_columns, std::size_t count,
                      const Comparison& comparison) {
  std::string text =
      fmt::format("| {} | {} |\n|", first_columns, fmt::join(comparison.models, " | "));
  for (std::size_t i = 0; i < count + comparison.models.size(); ++i) text += "---|";
  return text + "\n";
}

std::string summary_text(const Comparison& comparison) {
  std::string text = head_text("error of | quantities | criterion", 3, comparison);
  for (const Aspect& aspect : summarize(comparison)) {
    text += fmt::format("| {} | {} | each at most {}", aspect.title, aspect.quantities,
                        percent_text(aspect.max_error));
    if (aspect.max_mean_error) {
      text += fmt::format(", mean at most {}", percent_text(*aspect.max_mean_error));
    }
    text += " |";
    for (const ModelErrors& errors : aspect.models) {
      text += fmt::format(" **{}** mean {}, greatest {} |", errors.holds ? "+" : "-",
                          percent_text(errors.mean), percent_text(errors.max));
    }
    text += "\n";
  }
  return text;
}

std::string people_text(const ComparedExperiment& experiment) {
  if (experiment.people == 0) return "People walk around in a closed corridor.";
  const std::size_t passed = experiment.recorded_passages_s.size();
  const std::string people =
      counted(static_cast<std::int64_t>(experiment.people), "person", "people");
  if (passed == 0) {
    return fmt::format(
        "{}, of whom nobody passes the line in the recording: flow, T90 and time gaps cannot be "
        "compared.",
        people);
  }
  return passed == experiment.people
             ? fmt::format("{}; everybody passes the line.", people)
             : fmt::format("{}; {} of them pass the line in the recording.", people, passed);
}

std::string experiment_text(const ComparedExperiment& experiment, const Comparison& comparison) {
  std::string text = fmt::format("\n## {}\n\n{}\n\n", experiment.name, people_text(experiment));
  text += head_text("quantity | people", 2, comparison);
  for (const ComparedQuantity& quantity : experiment.quantities) {
    text += fmt::format("| {}{}{} | {} |", quantity.name, quantity.unit.empty() ? "" : ", ",
                        quantity.unit, recorded_text(quantity.recorded));
    for (std::size_t model = 0; model < comparison.models.size(); ++model) {
      text += fmt::format(" {} |", model_text(quantity, model));
    }
    text += "\n";
  }
  if (experiment.recorded_passages_s.empty()) return text;
  text += "| greatest difference of N-t curves | |";
  for (const Sample& differences : experiment.curve_differences) {
    text += fmt::format(" {} |", percent_text(differences.mean()));
  }
  return text + "\n";
}

ordered_json quantity_json(const ComparedQuantity& quantity, const Comparison& comparison) {
  ordered_json value = {{"name", quantity.name}, {"unit", quantity.unit}};
  if (quantity.at_density > 0) value["density_per_m2"] = quantity.at_density;
  value["recorded"] = quantity.recorded;
  for (std::size_t model = 0; model < comparison.models.size(); ++model) {
    const Sample& sample = quantity.models[model];
    const auto error = relative_error(quantity, model);
    value["models"].push_back({{"model", comparison.models[model]},
                               {"values", sample.values},
                               {"mean", sample.mean()},
                               {"half_interval", sample.half_interval()},
                               {"relative_error", error ? ordered_json(*error) : ordered_json()}});
  }
  return value;
}

ordered_json experiment_json(const ComparedExperiment& experiment, const Comparison& comparison) {
  ordered_json value = {{"name", experiment.name}, {"quantities", ordered_json::array()}};
  for (const ComparedQuantity& quantity : experiment.quantities) {
    value["quantities"].push_back(quantity_json(quantity, comparison));
  }
  if (experiment.people == 0) return value;
  value["people"] = experiment.people;
  value["passages_s"] = experiment.recorded_passages_s;
  for (std::size_t model = 0; model < comparison.models.size(); ++model) {
    value["models"].push_back({{"model", comparison.models[model]},
                               {"curve_differences", experiment.curve_differences[model].values},
                               {"passages_s", experiment.passages_s[model]}});
  }
  return value;
}

ordered_json aspect_json(const Aspect& aspect, const Comparison& comparison) {
  ordered_json value = {{"error_of", aspect.title},
                        {"quantities", aspect.quantities},
                        {"max_error", aspect.max_error}};
  if (aspect.max_mean_error) value["max_mean_error"] = *aspect.max_mean_error;
  for (std::size_t model = 0; model < comparison.models.size(); ++model) {
    const ModelErrors& errors = aspect.models[model];
    value["models"].push_back({{"model", comparison.models[model]},
                               {"mean_error", errors.mean},
                               {"max_error", errors.max},
                               {"holds", errors.holds}});
  }
  return value;
}

}  // namespace

std::string markdown(const Comparison& comparison, const Figures& figures) {
  std::string page = fmt::format(
      "# Models and recorded people\n\n"
      "Made by `throng validate-crowd --data` (docs/validation.md says what is compared): each "
      "experiment {} with each model. Values are means{}; differences from the recorded people are "
      "in brackets. **+** the criterion holds, **-** it does not.\n\n",
      comparison.seeds == 1 ? "once" : fmt::format("{} times", comparison.seeds),
      comparison.seeds == 1 ? "" : " ± half of their 95 % interval");
  page += summary_text(comparison);
  if (!figures.curves.empty()) {
    page += fmt::format("\n![Number of people who have passed, over time]({})\n", figures.curves);
  }
  if (!figures.diagram.empty()) {
    page += fmt::format("\n![Flow against density]({})\n", figures.diagram);
  }
  for (const ComparedExperiment& experiment : comparison.experiments) {
    page += experiment_text(experiment, comparison);
  }
  return page;
}

std::string comparison_json(const Comparison& comparison) {
  ordered_json document = {{"models", comparison.models},
                           {"seeds", comparison.seeds},
                           {"summary", ordered_json::array()},
                           {"experiments", ordered_json::array()}};
  for (const Aspect& aspect : summarize(comparison)) {
    document["summary"].push_back(aspect_json(aspect, comparison));
  }
  for (const ComparedExperiment& experiment : comparison.experiments) {
    document["experiments"].push_back(experiment_json(experiment, comparison));
  }
  return document.dump(1) + "\n";
}

}  // namespace throng::validation
