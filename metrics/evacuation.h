// The numbers of one run: escape curve, percentiles, shares of the exits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/drones.h"
#include "metrics/exit_totals.h"
#include "metrics/exits.h"
#include "metrics/exposure.h"
#include "metrics/flow_bound.h"
#include "metrics/journeys.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// When people first headed for an exit or followed a guide, and what came after.
struct Notification {
  int never = 0;                  ///< people who did not, in the time that the run had
  std::vector<double> times_s;    ///< of the others since they arrived, in order
  std::optional<double> first_s;  ///< the earliest of all, by the run's clock
  std::vector<double> escape_s;   ///< from then to the escape, of those who escaped, in order
};

/// What guides did for people.
struct GuidanceFigures {
  int led = 0;                 ///< people who followed at some time
  double mean_followed_s = 0;  ///< over those
  double mean_followed_m = 0;
  double flown_km = 0;  ///< of all drones
  double energy_wh = 0;
};

struct RunMetrics {
  int people = 0;
  double duration_s = 0;
  /// Share of people who have ever left Scenario::inside, at 0, 1, 2, ... s.
  std::vector<double> escape_curve;
  /// Times at which 25, 50, 75, 90, 95, 99 and 100 % have escaped; empty if not reached.
  struct Percentile {
    int percent;
    std::optional<double> time_s;
  };
  std::vector<Percentile> percentiles;
  /// Who was still inside at 300 and 600 s, and the mean time until then (restricted mean survival
  /// time); empty where the run ended before and not everybody was out.
  struct Horizon {
    double at_s;
    std::optional<int> not_escaped;
    std::optional<double> restricted_mean_s;
  };
  std::vector<Horizon> horizons;
  double mean_escape_time_s = 0;  ///< censored at the end of the run
  int not_escaped = 0;
  int falls_struck = 0;   ///< by a drone
  int falls_crushed = 0;  ///< by the crowd
  std::vector<ExitTotals> exits;
  std::optional<ExitBalance> balance;
  std::vector<DroneFigures> drones;
  Notification notification;
  GuidanceFigures guidance;
  std::vector<Journey> journeys;
  Exposure exposure;
  /// How soon everybody who was inside at the first notification could have been out (s from then);
  /// empty when nobody noticed.
  std::optional<FlowBound> bound;
};

/// `exits` is exit_series() of the same trace and scenario. Disasters are not people; everything is
/// 0 (and no percentile reached) when there is nobody.
RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits);

/// Raised whenever the meaning of a value in metrics.json or exits.csv changes (docs/metrics.md).
inline constexpr int kDefinitionsVersion = 3;

/// By how much sooner people escaped than in a run without guides of the same seed: the sum over
/// all people (s), positive when sooner; who did not escape counts with the end of the shorter run.
/// Throws InputError when the traces do not have the same agents.
double lead_efficiency_s(const world::Trace& trace, const world::Trace& without_guides,
                         const world::Scenario& scenario);

/// metrics.json: every value with its unit in its name, and the version of the definitions.
nlohmann::json to_json(const RunMetrics& metrics);

}  // namespace throng::metrics
