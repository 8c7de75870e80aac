// What one run of a study came to, kept as a small JSON file.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "metrics/flow_bound.h"
#include "sim/run.h"
#include "world/scenario.h"

namespace throng::study {

struct Outcome {
  int people = 0;
  double duration_s = 0;         ///< of the run; who is not out by then is censored
  double alarm_s = 0;            ///< all other times count from here
  std::vector<double> escape_s;  ///< of those who got out, in order
  std::vector<int> exit_use;     ///< per exit: who went through its door, less who came back
  int followed = 0;              ///< how many were in a state "Follow" at some time
  metrics::FlowBound bound;

  int not_escaped() const { return people - static_cast<int>(escape_s.size()); }
  /// With `duration_s - alarm_s` for those who did not get out.
  double mean_escape_s() const;
  /// When so many percent are out; infinite if never.
  double percentile_s(int percent) const;
};

nlohmann::json to_json(const Outcome& outcome);
/// Throws nlohmann::json::exception for anything that to_json() does not write.
Outcome outcome_from(const nlohmann::json& value);

/// Watches a run for its outcome; has seen enough when everybody is out.
class OutcomeObserver : public sim::RunObserver {
 public:
  /// `bound_spec`: for the bound, which counts from where people are at the alarm.
  OutcomeObserver(const world::Scenario& scenario, double duration_s, double alarm_s,
                  metrics::BoundSpec bound_spec);
  ~OutcomeObserver() override;

  void begin(const world::TraceHeader& header) override;
  void step(const world::CrowdStep& step) override;
  void event(const world::TraceEvent& event) override;
  bool done() const override;

  Outcome take();

 private:
  struct Doors;

  const world::Scenario& scenario_;
  metrics::BoundSpec bound_spec_;
  Outcome outcome_;
  std::vector<world::AgentRole> roles_;
  std::vector<bool> follows_;  // per state of the behaviour: its name is "Follow"
  std::vector<bool> followed_;
  std::unique_ptr<Doors> doors_;
  bool bound_done_ = false;
};

}  // namespace throng::study
