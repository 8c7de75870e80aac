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

/// Bounds of escape times (metrics/bounds/run_bound.h); infinite if the share never gets out.
struct BestFigures {
  double t50_s = 0;
  double t75_s = 0;
  double t90_s = 0;
  double t95_s = 0;
  double t100_s = 0;
  double mean_s = 0;
};

/// Result of one run.
struct Outcome {
  metrics::EscapeTimes escapes;            ///< as in metrics.json
  metrics::PeopleCounts counts;            ///< as in metrics.json
  int followed = 0;                        ///< people who followed a guide at some time
  std::vector<std::string> warnings = {};  ///< of the simulation
  BestFigures bound;                       ///< lower bound, if all people know of the alarm at once
  BestFigures reference;                   ///< reference times of metrics::ReferenceSpec

  /// The time by which `percent` % of the people are out; infinite if never.
  double percentile_s(int percent) const;
  /// Mean of min(escape time, until_s); NaN if it is not known.
  double restricted_mean_s(double until_s) const;
};

nlohmann::json to_json(const Outcome& outcome);
/// The inverse of to_json(). Throws nlohmann::json::exception for other values.
Outcome outcome_from(const nlohmann::json& value);

/// Observes a run for its outcome; ends the run once all people are out.
class OutcomeObserver : public sim::RunObserver {
 public:
  /// The scenario must outlive this object. `model` is the run's pedestrian model
  /// (crowd/state/model.h).
  OutcomeObserver(const world::Scenario& scenario, world::Alarm alarm,
                  metrics::ReferenceSpec reference, std::string model);
  ~OutcomeObserver() override;

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  bool done() const override;

  /// The outcome; call it once the run has ended.
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
