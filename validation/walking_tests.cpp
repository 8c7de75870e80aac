// IMO's exit, and tests of our own: how people move where no standard asks.
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "validation/flow.h"
#include "validation/suite.h"
#include "validation/walking.h"

namespace throng::validation {

namespace {

std::size_t seeds_of(Effort effort) { return effort == Effort::full ? 5 : 1; }

/// The worst of several runs.
template <typename Measure>
double greatest(Effort effort, const Measure& measure) {
  double worst = measure(1);
  for (std::size_t seed = 2; seed <= seeds_of(effort); ++seed)
    worst = std::max(worst, measure(seed));
  return worst;
}

Verdict exit_flow(const Tested& tested, Effort effort) {
  bool all_out = true;
  const double flow = greatest(effort, [&](std::uint64_t seed) {
    const ExitRun run = leave_room(tested, seed);
    all_out = all_out && run.all_out;
    return run.flow_per_s;
  });
  return {all_out && flow <= 1.33, fmt::format("{:.2f} /s{}", flow, all_out ? "" : ", jams")};
}

Verdict capacity_drop(const Tested& tested, Effort) {
  double peak = 0;
  for (const double density : {1.2, 1.5, 1.8, 2.1}) {
    peak = std::max(peak, walk_in_ring(tested, density, 1).speed_mps * density);
  }
  const double dense = walk_in_ring(tested, 3, 1).speed_mps * 3;
  const double packed = walk_in_ring(tested, 5.5, 1).speed_mps * 5.5;
  return {peak > 0 && dense <= 0.7 * peak && packed < 0.5,
          fmt::format("{:.2f}, {:.2f}, {:.2f} /(m s)", peak, dense, packed)};
}

Verdict open_square(const Tested& tested, Effort effort) {
  const auto stuck = [&](double density) {
    return greatest(effort,
                    [&](std::uint64_t seed) { return cross_square(tested, density, seed).stuck; });
  };
  const double half = stuck(0.5);
  const double one = stuck(1);
  return {half <= 0.05 && one <= 0.05, fmt::format("{:.0f} %, {:.0f} %", 100 * half, 100 * one)};
}

Verdict against_each_other(const Tested& tested, Effort effort) {
  const CounterRun alone = pass_corridor(tested, 0, 1);
  std::size_t left = alone.left;
  const double against = greatest(effort, [&](std::uint64_t seed) {
    const CounterRun run = pass_corridor(tested, 100, seed);
    left += run.left;
    return run.time_s;
  });
  return {left == 0 && against <= 2.5 * alone.time_s,
          fmt::format("{:.0f}, {:.0f} s{}", alone.time_s, against, left == 0 ? "" : ", jams")};
}

Verdict both_ways(const Tested& tested, Effort effort) {
  const double lost = greatest(effort, [&](std::uint64_t seed) {
    const TwoWayRun run = walk_both_ways(tested, 0.75, seed);
    return 0.75 - std::min(run.there, run.back);
  });
  return {lost <= 0.25 * 0.75, fmt::format("{:.2f} /(m s)", 0.75 - lost)};
}

Verdict around_corner(const Tested& tested, Effort) {
  std::string measured;
  bool passed = true;
  for (const double width_m : {2.0, 4.0}) {
    const double straight = corridor_flow(tested, false, width_m, 1);
    const double corner = corridor_flow(tested, true, width_m, 1);
    passed = passed && straight > 0 && corner >= 0.85 * straight;
    measured += fmt::format("{}{:.2f}, {:.2f}", measured.empty() ? "" : "; ", straight, corner);
  }
  return {passed, measured + " /(m s)"};
}

Verdict evasion(const Tested& tested, Effort) {
  const MeetingRun run = meet(tested, 0.3, 1);
  return {run.passed && run.begins_s >= 2 && run.acceleration_mps2 <= 1,
          fmt::format("{:.1f} s, {:.1f} m/s²{}", run.begins_s, run.acceleration_mps2,
                      run.passed ? "" : ", they touch")};
}

Verdict queue(const Tested& tested, Effort) {
  const QueueRun run = stand_in_queue(tested, 1);
  return {run.passed > 0 && run.turns < 1,
          fmt::format("{:.1f} turns, {:.1f} stops", run.turns, run.stops)};
}

}  // namespace

std::vector<Test> walking_tests() {
  return {
      {"imo_4", "IMO 4, NIST 5.2",
       "100 people from a room of 8 m x 5 m through an exit of 1 m; the fastest of 5 runs",
       "at most 1.33 /s over the entire time; all out", exit_flow},
      {"capacity_drop", "Capacity drop",
       "ring of 3 m x 79 m: the greatest flow from 1.2 to 2.1 /m², then 3 and 5.5 /m²",
       "ours: at 3 /m² at most 70 % of the greatest, at 5.5 /m² below 0.5 /(m s)", capacity_drop},
      {"open_square", "Open square",
       "0.5 and 1 people/m² on 30 m x 30 m who walk to random places; the worst of 5 runs",
       "ours: after 2 minutes at most 5 % get less than 1 m far in 10 s", open_square},
      {"against", "Counter-flow",
       "NIST 2.8 to its end: 100 people alone, then against 100; the slowest of 5 runs",
       "ours: all get across, in at most 2.5 times the time", against_each_other},
      {"two_way", "Two-way corridor",
       "4 m wide; 0.75 /(m s) come in at each end; the worst of 5 runs",
       "ours: at least 75 % of them come out at the other", both_ways},
      {"corner", "Corner", "corridors 2 m and 4 m wide, straight and with a turn by 90°",
       "ours: at least 85 % of the flow", around_corner},
      {"evasion", "Evasion", "two people who walk towards each other, 0.3 m aside",
       "ours: they do not touch; begins 2 s before they meet, at most 1 m/s²", evasion},
      {"queue", "Queue", "150 people before a door of 0.8 m, from 20 to 60 s",
       "ours: less than one turn of the heading by more than 90° per person and minute", queue},
  };
}

}  // namespace throng::validation
