// Earliest escape times of the people of a run: a lower bound, and a reference with mean flows.
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

/// Possible escape times of the evacuees of a run, each from the later of alarm and arrival, as in
/// EscapeTimes.
struct BestTimes {
  std::vector<double> escape_s;  ///< one per evacuee, sorted; infinite: never sets out
  double mean_s = 0;             ///< people not out at the end of the run count until then
  int raised_doors = 0;          ///< doors whose flow in the run exceeded the measured capacity

  std::optional<double> percentile_s(int percent) const;
};

/// When people notice the alarm.
enum class Knowledge {
  as_noticed,  ///< as in the run; people who neither noticed nor escaped never set out
  at_once      ///< at the later of alarm and arrival
};

/// Parameters of lower_bound().
struct BoundSpec {
  std::string model;        ///< pedestrian model (crowd/state/model.h), for the doors' capacity
  double max_radius_m = 0;  ///< max radius of all people, by which doors are widened
  Knowledge knowledge = Knowledge::as_noticed;
};

/// Lower bounds of percentiles and mean, which no run of these people can undercut. Each person
/// sets out from the position at the time of noticing, takes the shortest path to any open door
/// (metrics/bounds/path_bound.h) at the person's max speed in the run, passes the door within its
/// capacity (metrics/exits/door_capacity.h), and continues to the nearest side of Scenario::inside
/// at the max speed of all people. The run itself limits the model: nobody reaches a door later, no
/// door passes fewer people or closes earlier than in the run, and people who left through no door
/// are out as soon as they can reach the nearest side. People present at the alarm share the doors'
/// capacity; later ones have it for themselves. Nothing without evacuees.
std::optional<BestTimes> lower_bound(const world::Scenario& scenario,
                                     const std::vector<PersonRecord>& people,
                                     const world::Alarm& alarm, double end_s,
                                     const BoundSpec& spec);

/// Parameters of reference_time() that replace those of the run.
struct ReferenceSpec {
  double speed_mps = 2;  ///< speed of all people, straight to the doors, ignoring walls
  std::vector<double> capacity_per_s;  ///< per exit of the scenario, people
};

/// A reference, which real crowds can exceed temporarily: the earliest-arrival flow through doors
/// with their mean capacity (docs/metrics.md) or that of the spec. Without a spec people walk at
/// their max desired speed along the shortest path of `distances` (walking_distances()). Nothing
/// without evacuees or exits.
std::optional<BestTimes> reference_time(const world::Scenario& scenario,
                                        const std::vector<PersonRecord>& people,
                                        const world::Alarm& alarm, double end_s,
                                        Knowledge knowledge,
                                        const std::vector<WalkingDistance>& distances);
std::optional<BestTimes> reference_time(const world::Scenario& scenario,
                                        const std::vector<PersonRecord>& people,
                                        const world::Alarm& alarm, double end_s,
                                        Knowledge knowledge, const ReferenceSpec& spec);

/// Ratio of the run's percentile to that of `best`; nothing if either was not reached or the latter
/// is 0.
std::optional<double> ratio_to(const BestTimes& best, const EscapeTimes& times, int percent);

/// The times of `best`, and the ratios of the run's times to them.
nlohmann::json to_json(const std::optional<BestTimes>& best, const EscapeTimes& times);

}  // namespace throng::metrics
