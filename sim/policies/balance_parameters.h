// Figures of the guidance policy "balance".
#pragma once

namespace throng::sim {

/// Figures without a source are assumptions, with which the results of docs/guidance.md were
/// measured; their influence on those results has not been measured.
struct BalanceParameters {
  double fly_speed_mps = 4;
  double lead_speed_mps = 1.6;  ///< below the 2 m/s of running people
  int max_batch = 50;           ///< people led at once
  double decide_every_s = 0.5;

  // People within reach of a beacon, at rest and at a door.
  double reach_m = 6;  ///< of the beacon
  double stands_mps = 0.3;
  double at_door_m = 5;  ///< nearer people count as out

  // Trips.
  double min_saving_s = 15;  ///< people times seconds that a trip must save
  double idle_s = 40;        ///< lost by each idle person who is not fetched
  double half_worth_s = 20;  ///< a trip that takes so long is worth half
  double abandoned_m = 3;    ///< people who did not come with the drone are left alone ...
  double abandoned_s = 40;   ///< ... for this time
  /// Fewest people per second of travel who are worth telling about the alarm.
  double min_told_per_s = 0.3;

  // Leads.
  double min_collect_s = 2;  ///< with the beacon on
  double max_collect_s = 6;
  double line_up_m = 9;        ///< a batch is long: nearer, its tail would come along the wall
  double behind_m = 9;         ///< a follower farther away is lost
  double max_release_s = 20;   ///< waited beyond the door for followers who are near
  double max_wait_lost_s = 3;  ///< waited there if none is near
  int max_rescues = 3;         ///< of lost followers, in a lead
};

inline constexpr BalanceParameters kBalance;

}  // namespace throng::sim
