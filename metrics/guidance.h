// Effect of guides on people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/drones.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

struct GuidanceFigures {
  int led = 0;                 ///< people who followed at some time
  double mean_followed_s = 0;  ///< over those
  double mean_followed_m = 0;
  double flown_km = 0;  ///< of all drones
  double energy_wh = 0;
};

GuidanceFigures measure_guidance(const std::vector<PersonRecord>& people,
                                 const std::vector<DroneFigures>& drones);

nlohmann::json to_json(const GuidanceFigures& guidance);

/// By how much sooner people escaped than in the same run without guides (s), positive when sooner.
/// Both runs count as ending when the shorter one does, and who had not escaped by then as escaping
/// then.
struct LeadEffect {
  double all_s = 0;  ///< sum over all people
  double led_s = 0;  ///< sum over those who followed at some time
  int censored = 0;  ///< people who had not escaped by the end in one of the runs or in both
};

/// Throws InputError when the runs are not of the same scenario, seed and agents, or somebody
/// follows a drone in the one without guides.
LeadEffect lead_effect(const world::Trace& trace, const world::Trace& without_guides,
                       const world::Scenario& scenario);

/// Adds the effect to to_json(GuidanceFigures).
void add_to_json(const LeadEffect& effect, nlohmann::json& guidance);

}  // namespace throng::metrics
