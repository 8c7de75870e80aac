// How soon the people of a run could have been out: a lower bound, and a reference at mean flows.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/basis/walking_distance.h"
#include "metrics/people/escape_times.h"
#include "world/scenario.h"

namespace throng::metrics {

/// Escape times of the evacuees of a run as they could have been, each from the later of alarm and
/// arrival, as in EscapeTimes.
struct BestTimes {
  std::vector<double> escape_s;  ///< one per evacuee, in order; infinite for who never sets out
  double mean_s = 0;             ///< people not out when the run ends count with the time watched
  int raised_doors = 0;          ///< doors that passed more in the run than the measured capacity

  std::optional<double> percentile_s(int percent) const;
};

/// From when on people know of the alarm.
enum class Knowledge {
  as_noticed,  ///< as each did in the run; who neither noticed nor escaped never sets out
  at_once      ///< from the alarm on, or from the arrival if that is later
};

struct BoundSpec {
  std::string model;        ///< of the pedestrians (crowd/model.h), for the doors' capacity
  double max_radius_m = 0;  ///< greatest of all people, by which doors are wider for their centers
  Knowledge knowledge = Knowledge::as_noticed;
};

/// No run of these people can have smaller percentiles or a smaller mean: everybody sets out where
/// they were when they knew, goes at the greatest speed that they reached in the run on the
/// shortest path to any open door (metrics/bounds/path_bound.h), which passes at most its capacity
/// (metrics/exits/door_capacity.h), and goes on to the nearest side of Scenario::inside at the
/// greatest speed of all. The run itself bounds the model: nobody is at a door later than they
/// passed it, no door passes fewer or closes sooner, and who got out through no door does so at
/// once when they can be at the nearest side. People present at the alarm share the doors'
/// capacity; later ones have it for themselves. Empty without evacuees.
std::optional<BestTimes> lower_bound(const world::Scenario& scenario,
                                     const std::vector<PersonRecord>& people,
                                     const world::Alarm& alarm, double end_s,
                                     const BoundSpec& spec);

/// Knowledge assumed by a reference time.
struct ReferenceSpec {
  double speed_mps = 2;                ///< of everybody, straight to the doors through all walls
  std::vector<double> capacity_per_s;  ///< per exit of the scenario, people
};

/// A reference, which real crowds can beat for a while: the quickest flow through doors that pass
/// their mean capacity (docs/metrics.md) or that of the spec. Without a spec people go at the
/// greatest speed that each desired, on the shortest path of `distances` (walking_distances()).
/// Empty without evacuees or exits.
std::optional<BestTimes> reference_time(const world::Scenario& scenario,
                                        const std::vector<PersonRecord>& people,
                                        const world::Alarm& alarm, double end_s,
                                        Knowledge knowledge,
                                        const std::vector<WalkingDistance>& distances);
std::optional<BestTimes> reference_time(const world::Scenario& scenario,
                                        const std::vector<PersonRecord>& people,
                                        const world::Alarm& alarm, double end_s,
                                        Knowledge knowledge, const ReferenceSpec& spec);

/// Ratio of the run's percentile to that of `best`; empty if either was not reached or the latter
/// is 0.
std::optional<double> ratio_to(const BestTimes& best, const EscapeTimes& times, int percent);

/// The times, and the ratios of those of the run to them.
nlohmann::json to_json(const std::optional<BestTimes>& best, const EscapeTimes& times);

}  // namespace throng::metrics
