#include "validation/experiments/comparison.h"

#include <cmath>
#include <mutex>

#include "base/compute/mean_interval.h"
#include "base/compute/run_items.h"

namespace throng::validation {

double Sample::mean() const { return throng::mean(values); }

double Sample::half_interval() const {
  if (values.size() < 2) return 0;
  const Interval interval = student_interval(values, 0.95);
  return 0.5 * (interval.high - interval.low);
}

namespace {

ComparedExperiment collect(const Replay& replay, const std::vector<std::vector<Measures>>& runs) {
  const Measures& recorded = replay.recorded();
  ComparedExperiment compared;
  compared.name = replay.experiment().name;
  compared.people = recorded.people;
  compared.recorded_passages_s = recorded.passages_s;
  for (std::size_t q = 0; q < recorded.quantities.size(); ++q) {
    const Quantity& quantity = recorded.quantities[q];
    ComparedQuantity row{quantity.name, quantity.unit, quantity.value, quantity.at_density, {}};
    for (const std::vector<Measures>& model : runs) {
      Sample& sample = row.models.emplace_back();
      for (const Measures& run : model) sample.values.push_back(run.quantities[q].value);
    }
    compared.quantities.push_back(std::move(row));
  }
  if (!replay.experiment().recording) return compared;
  for (const std::vector<Measures>& model : runs) {
    Sample& differences = compared.curve_differences.emplace_back();
    std::vector<std::vector<double>>& curves = compared.passages_s.emplace_back();
    for (const Measures& run : model) {
      differences.values.push_back(curve_difference(recorded.passages_s, run.passages_s));
      curves.push_back(run.passages_s);
    }
  }
  return compared;
}

}  // namespace

Comparison compare(const std::vector<Experiment>& experiments, const std::vector<Tested>& models,
                   std::size_t seeds, int threads, const ComparisonProgress& progress,
                   const std::stop_token& stop) {
  std::vector<Replay> replays;
  replays.reserve(experiments.size());
  for (const Experiment& experiment : experiments) replays.emplace_back(experiment);
  const std::size_t total = replays.size() * models.size() * seeds;
  std::vector<std::vector<std::vector<Measures>>> runs(
      replays.size(),
      std::vector<std::vector<Measures>>(models.size(), std::vector<Measures>(seeds)));
  std::mutex mutex;
  std::size_t done = 0;
  run_items(total, threads, stop, [&](std::size_t number) {
    const std::size_t seed = number % seeds;
    const std::size_t model = number / seeds % models.size();
    const std::size_t experiment = number / seeds / models.size();
    runs[experiment][model][seed] = replays[experiment].simulate(models[model], seed + 1, stop);
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(done, total);
  });
  Comparison comparison{{}, seeds, {}};
  for (const Tested& tested : models) comparison.models.push_back(title(tested));
  for (std::size_t i = 0; i < replays.size(); ++i) {
    comparison.experiments.push_back(collect(replays[i], runs[i]));
  }
  return comparison;
}

}  // namespace throng::validation
