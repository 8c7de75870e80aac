// Result of one run of a study, stored as a small JSON file.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "metrics/bounds/run_bound.h"
#include "metrics/people/people_counts.h"
#include "sim/run.h"
#include "world/scenario.h"

namespace throng::study {

/// Times by which people could have been out (metrics/bounds/run_bound.h); infinite if never.
struct BestFigures {
  double t50_s = 0;
  double t75_s = 0;
  double t90_s = 0;
  double t95_s = 0;
  double t100_s = 0;
  double mean_s = 0;
};

struct Outcome {
  metrics::EscapeTimes escapes;  ///< as in metrics.json
  metrics::PeopleCounts counts;  ///< as in metrics.json
  int followed = 0;              ///< people who followed a guide at some time
  BestFigures bound;             ///< with people who know of the alarm at once
  BestFigures reference;

  /// When so many percent are out; infinite if never.
  double percentile_s(int percent) const;
  /// NaN where it is not known.
  double restricted_mean_s(double until_s) const;
};

nlohmann::json to_json(const Outcome& outcome);
/// Throws nlohmann::json::exception for anything that to_json() does not write.
Outcome outcome_from(const nlohmann::json& value);

/// Watches a run for its outcome; has seen enough when everybody is out.
class OutcomeObserver : public sim::RunObserver {
 public:
  /// The scenario outlives it. `model`: the pedestrian model of the run (crowd/model.h).
  OutcomeObserver(const world::Scenario& scenario, world::Alarm alarm,
                  metrics::ReferenceSpec reference, std::string model);
  ~OutcomeObserver() override;

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  bool done() const override;

  /// Once the run has ended.
  Outcome take() const;

 private:
  const world::Scenario& scenario_;
  world::Alarm alarm_;
  metrics::ReferenceSpec reference_;
  std::string model_;
  double max_radius_m_ = 0;
  std::unique_ptr<metrics::PeopleTracker> tracker_;
};

}  // namespace throng::study
