// The effect of guides on people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/drones.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// Metrics of guidance over a run.
struct GuidanceFigures {
  int led = 0;                 ///< people who followed a guide at any time
  double mean_followed_s = 0;  ///< mean over these people
  double mean_followed_m = 0;
  double flown_km = 0;  ///< total of all drones
  double energy_wh = 0;
};

GuidanceFigures measure_guidance(const std::vector<PersonRecord>& people,
                                 const std::vector<DroneFigures>& drones);

nlohmann::json to_json(const GuidanceFigures& guidance);

/// Person-seconds saved in comparison with the same run without guides; positive if people escaped
/// earlier with guides. Both runs are cut at the end of the shorter one; people who had not escaped
/// by then count as escaping then.
struct LeadEffect {
  double all_s = 0;  ///< sum over all people
  double led_s = 0;  ///< sum over the people who followed at any time
  int censored = 0;  ///< people who had not escaped by the end of at least one run
};

/// Compares two runs. Throws InputError if they differ in scenario, seed or agents, or if a person
/// follows a drone in the run without guides.
LeadEffect lead_effect(const world::Trace& trace, const world::Trace& without_guides,
                       const world::Scenario& scenario);

/// Adds the effect to to_json(GuidanceFigures).
void add_to_json(const LeadEffect& effect, nlohmann::json& guidance);

}  // namespace throng::metrics
