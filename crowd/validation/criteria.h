// Criteria of the tests as functions of measured values: a test simulates, measures and asks here.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "crowd/validation/flow.h"
#include "crowd/validation/suite.h"
#include "crowd/validation/walking.h"

namespace throng::validation::criteria {

/// RiMEA 1: 26 to 34 s for 40 m, inside the corridor all the time.
Verdict corridor_time(double time_s, bool inside);
/// NIST 2.1: 40 m at 1 m/s within 5 %.
Verdict corridor_speed(double time_s);
/// RiMEA 4: speeds at growing densities fall.
Verdict falling_speeds(const std::vector<double>& speeds_mps);
/// RiMEA 5: agent i starts 10 (i + 1) s after the beginning, within 0.5 s.
Verdict start_times(const std::vector<double>& started_s, bool all_out);
/// RiMEA 6 and NIST 2.3: nobody in a wall (`outside`: agents times steps), all out before `max_s`.
Verdict corner_walk(std::optional<double> end_s, long outside, double max_s);
/// RiMEA 7: range of free speed of an age group, and the measured speeds.
struct AgeSpeeds {
  double min_mps = 0;
  double max_mps = 0;
  std::vector<double> measured_mps;
};
/// Speeds are in their range within 0.03 m/s; means fall from the second group on.
Verdict age_speeds(const std::vector<AgeSpeeds>& groups);
/// RiMEA 9: half the exits take 1.6 to 2.4 times as long.
Verdict exit_ratio(std::optional<double> four_exits_s, std::optional<double> two_exits_s);
/// RiMEA 10 and NIST 3.1: people per exit are those assigned to it.
Verdict exit_assignment(const std::array<int, 2>& used, const std::array<int, 2>& assigned);
/// RiMEA 11: all leave, most by the first (nearer) exit, some by the second.
Verdict exit_shares(const std::array<int, 2>& used, int people);
/// RiMEA 12 a, b: the first time is at most (`strict`: below) the second; infinite where it jams.
Verdict ordered_times(double first_s, double second_s, bool strict);
/// RiMEA 12 c: medians over runs.
struct SeriesFlow {
  double difference_per_s = 0;  ///< flow at the first door less that at the last; -infinity: jams
  double first_queue = 0;       ///< people
  double last_queue = 0;
};
Verdict series_flow(const SeriesFlow& medians);
/// RiMEA 12 d: flows through doors of growing width grow.
Verdict growing_flows(const std::vector<double>& flows_per_s);
/// RiMEA 15: evacuation times of the short path, the corner and the long path are in this order.
Verdict corner_times(std::optional<double> short_s, std::optional<double> corner_s,
                     std::optional<double> long_s);
/// RiMEA 16: speeds of a single file of `people` in a ring of 26 m, by free speed.
struct FileSpeeds {
  std::size_t people = 0;
  double at_134_mps = 0;
  double at_080_mps = 0;
  double at_160_mps = 0;
};
/// Three quarters within 0.25 m/s of (headway - 0.36 m) / 1.06 s; ordered by free speed.
Verdict single_file_speeds(const std::vector<FileSpeeds>& files);

/// NIST 2.4: mean 1.2 and deviation 0.2 m/s of 100 speeds within three standard errors.
Verdict speed_distribution(const std::vector<double>& speeds_mps);
/// NIST 2.8: people across do not grow with the number of others.
Verdict falling_counts(const std::vector<int>& across);
/// NIST 4.1: some use the exit before it closes, none after.
Verdict closed_exit(int early, int late, bool all_out);
/// NIST 5.1: denser before the corridor than in it (1/m^2).
Verdict congested_entrance(double door_density, double corridor_density, bool all_out);

/// Fundamental diagram: within 0.2 m/s of Weidmann's.
Verdict weidmann_diagram(const std::vector<DensitySpeed>& measured);
/// Doors and passages: 1.2 to 2.3 people per meter and second.
Verdict specific_flows(const std::vector<double>& flows);
/// IMO 4: at most 1.33 people per second in each run.
Verdict exit_flow(const std::vector<ExitRun>& runs);
/// Flow at 3 /m^2 at most 70 % of the greatest, at 5.5 /m^2 below 0.5 /(m s). Values in 1/(m s).
Verdict capacity_drop(double peak, double dense, double packed);
/// At most 5 % of people are stuck; worst shares at 0.5 and 1 /m^2.
Verdict open_square(double half_density, double full_density);
/// All get across, in at most 2.5 times the time that they need alone.
Verdict counter_flow(const CounterRun& alone, const std::vector<CounterRun>& against);
/// At least 75 % of those who enter (`each`, 1/(m s)) come out.
Verdict two_way(const std::vector<TwoWayRun>& runs, double each);
/// Flows of a straight corridor and one with a turn, 1/(m s).
struct CornerFlow {
  double straight = 0;
  double corner = 0;
};
/// At least 85 % of the flow.
Verdict corner_flow(const std::vector<CornerFlow>& flows);
/// They do not touch, begin 2 s before they meet and accelerate by at most 1 m/s^2.
Verdict evasion(const MeetingRun& run);
/// Some pass; less than one turn per person and minute.
Verdict queue(const QueueRun& run);

}  // namespace throng::validation::criteria
