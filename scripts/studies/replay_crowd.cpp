// Replays experiments with one model and other constants than its own, for fits and comparisons.
//
//   replay_crowd FOLDER MODEL [seeds=N] [only=NAME,...] [v0=..] [sd=..] [CONSTANT=VALUE ...]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "crowd/state/model.h"
#include "validation/experiments/comparison.h"

namespace throng::validation {
namespace {

void run(std::span<char* const> words) {
  Tested tested{words[2]};
  crowd::Node constants{std::string(crowd::find_model(tested.model).tag)};
  std::size_t seeds = 2;
  std::vector<std::string> only;
  double v0 = 0;
  double sd = 0.26;
  for (const std::string word : words.subspan(3)) {
    const auto equals = word.find('=');
    const std::string name = word.substr(0, equals);
    std::string value = word.substr(equals + 1);
    if (name == "seeds") {
      seeds = std::stoul(value);
    } else if (name == "v0") {
      v0 = std::stod(value);
    } else if (name == "sd") {
      sd = std::stod(value);
    } else if (name == "only") {
      for (value += ','; !value.empty(); value.erase(0, value.find(',') + 1)) {
        only.push_back(value.substr(0, value.find(',')));
      }
    } else {
      constants.set({name, value});
    }
  }
  if (!constants.attributes.empty()) tested.constants = {constants};
  std::vector<Experiment> experiments = find_experiments(words[1]);
  std::erase_if(experiments, [&](const Experiment& experiment) {
    return !only.empty() && std::none_of(only.begin(), only.end(), [&](const std::string& part) {
      return experiment.name.find(part) != std::string::npos;
    });
  });
  if (v0 > 0) {
    for (Experiment& experiment : experiments) experiment.free_speeds = {v0, sd};
  }
  const Comparison comparison = compare(experiments, {tested}, seeds, 0);
  for (const ComparedExperiment& experiment : comparison.experiments) {
    fmt::print("{}", experiment.name);
    if (!experiment.curve_differences.empty()) {
      fmt::print(" (N-t {:.0f} %)", 100 * experiment.curve_differences[0].mean());
    }
    fmt::print("\n");
    for (const ComparedQuantity& quantity : experiment.quantities) {
      const double mean = quantity.models[0].mean();
      fmt::print("   {:18} {:7.3f} {:7.3f} +-{:.3f} {:+4.0f} %\n", quantity.name, quantity.recorded,
                 mean, quantity.models[0].half_interval(), 100 * (mean / quantity.recorded - 1));
    }
  }
}

}  // namespace
}  // namespace throng::validation

int main(int argc, char** argv) {
  try {
    throng::validation::run({argv, static_cast<std::size_t>(argc)});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
