// Pass criteria of the tests as functions of measured values. Each returns the verdict with the
// measured values as text; an empty time means that people blocked each other.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "validation/calm.h"
#include "validation/flow.h"
#include "validation/suite.h"
#include "validation/walking.h"

namespace throng::validation::criteria {

/// RiMEA 1: 40 m take 26 to 34 s; the person stays inside the corridor.
Verdict corridor_time(double time_s, bool inside);
/// NIST 2.1: 40 m at 1 m/s, within 5 %.
Verdict corridor_speed(double time_s);
/// RiMEA 4: speeds, given by increasing density, decrease.
Verdict falling_speeds(const std::vector<double>& speeds_mps);
/// RiMEA 5: agent i starts 10 (i + 1) s after the beginning, within 0.5 s, and all leave.
Verdict start_times(const std::vector<double>& started_s, bool all_out);
/// RiMEA 6 and NIST 2.3: nobody is in a wall (`outside`: sum over steps), and all leave before
/// `max_s`.
Verdict corner_walk(std::optional<double> end_s, long outside, double max_s);
/// RiMEA 7: permitted range of the free speed of an age group, and measured speeds.
struct AgeSpeeds {
  double min_mps = 0;
  double max_mps = 0;
  std::vector<double> measured_mps;
};
/// Speeds are in the range of their group within 0.03 m/s; means decrease from the second group on.
Verdict age_speeds(const std::vector<AgeSpeeds>& groups);
/// RiMEA 9: with half the exits, the evacuation takes 1.6 to 2.4 times as long.
Verdict exit_ratio(std::optional<double> four_exits_s, std::optional<double> two_exits_s);
/// RiMEA 10 and NIST 3.1: each exit is used by the people assigned to it.
Verdict exit_assignment(const std::array<int, 2>& used, const std::array<int, 2>& assigned);
/// RiMEA 11: all leave, more than half by the first (nearer) exit and some by the second.
Verdict exit_shares(const std::array<int, 2>& used, int people);
/// RiMEA 12 a, b: the first time is at most (`strict`: less than) the second; infinite: people
/// blocked each other.
Verdict ordered_times(double first_s, double second_s, bool strict);
/// RiMEA 12 c: medians over runs.
struct SeriesFlow {
  /// Flow at the first door minus flow at the last door; -infinity: blocked.
  double difference_per_s = 0;
  double first_queue = 0;  ///< number of people
  double last_queue = 0;
};
/// The first door has at most 0.05 1/s less flow than the last one, and a longer queue.
Verdict series_flow(const SeriesFlow& medians);
/// RiMEA 12 d: flows, given by increasing width of the door, increase.
Verdict growing_flows(const std::vector<double>& flows_per_s);
/// RiMEA 15: the times for the short path, the corner and the long path are in ascending order.
Verdict corner_times(std::optional<double> short_s, std::optional<double> corner_s,
                     std::optional<double> long_s);
/// RiMEA 16: mean speeds of `people` in single file in a ring of 26 m, for free speeds of 1.34,
/// 0.80 and 1.60 m/s.
struct FileSpeeds {
  std::size_t people = 0;
  double at_134_mps = 0;
  double at_080_mps = 0;
  double at_160_mps = 0;
};
/// At least three quarters are within 0.25 m/s of (headway - 0.36 m) / 1.06 s, and speeds increase
/// with the free speed.
Verdict single_file_speeds(const std::vector<FileSpeeds>& files);

/// NIST 2.4: mean and standard deviation of 100 speeds are within three standard errors of 1.2 and
/// 0.2 m/s.
Verdict speed_distribution(const std::vector<double>& speeds_mps);
/// NIST 2.8: the number of people who get across does not increase with the counter-flow.
Verdict falling_counts(const std::vector<int>& across);
/// NIST 4.1: some use the exit before it closes, none afterwards.
Verdict closed_exit(int early, int late, bool all_out);
/// NIST 5.1: density (1/m^2) is higher before the corridor than in it.
Verdict congested_entrance(double door_density, double corridor_density, bool all_out);

/// Fundamental diagram: speeds are within 0.2 m/s of Weidmann's.
Verdict weidmann_diagram(const std::vector<DensitySpeed>& measured);
/// Doors and passages: specific flows are 1.2 to 2.3 1/(m s).
Verdict specific_flows(const std::vector<double>& flows);
/// Flows of a door (1/s) over the shapes in which it is drawn.
struct DoorFlows {
  double min_per_s = 0;
  double max_per_s = 0;
};
/// Flows of each door, by increasing width, are within 15 % of their middle, which grows with
/// width.
Verdict drawn_doors(const std::vector<DoorFlows>& doors);
/// IMO 4: flow is at most 1.33 1/s in each run.
Verdict exit_flow(const std::vector<ExitRun>& runs);
/// Flows in 1/(m s): at 3 1/m^2 at most 70 % of the peak, at 5.5 1/m^2 below 0.5.
Verdict capacity_drop(double peak, double dense, double packed);
/// Shares of people who are stuck, at 0.5 and 1 1/m^2: at most 2 %.
Verdict open_square(double half_density, double full_density);
/// All get across, in at most 2.5 times the time without counter-flow.
Verdict counter_flow(const CounterRun& alone, const std::vector<CounterRun>& against);
/// The outflow is at least 75 % of the inflow `each` (1/(m s)), and at most 2 % are stuck.
Verdict two_way(const std::vector<TwoWayRun>& runs, double each);
/// Flows of a straight corridor, and of corridors with a turn around a block and around thin walls
/// (1/(m s)).
struct CornerFlow {
  double straight = 0;
  double block = 0;
  double thin = 0;
};
/// Each flow with a turn is at least 85 % of the straight one.
Verdict corner_flow(const std::vector<CornerFlow>& flows);
/// The two do not touch, start to evade at least 2 s before they meet, and accelerate by at most 1
/// m/s^2.
Verdict evasion(const MeetingRun& run);
/// In each scene, people turn less than once per minute, slow people turn at less than 30°/s, and
/// bodies overlap by at most 2 cm.
Verdict calm(const std::vector<CalmRun>& runs);
/// Greatest flows of corridors of several widths (1/(m s)): the greatest is at most 10 % above the
/// least.
Verdict same_capacity(const std::vector<double>& flows);
/// Some people pass the door; there is less than one turn per person and minute.
Verdict queue(const QueueRun& run);

}  // namespace throng::validation::criteria
