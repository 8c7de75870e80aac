// IMO's exit, and tests of our own: how people move where no standard asks.
#include <algorithm>
#include <vector>

#include "validation/calm.h"
#include "validation/criteria.h"
#include "validation/flow.h"
#include "validation/suite.h"
#include "validation/walking.h"

namespace throng::validation {

namespace {

std::size_t count_seeds(Effort effort) { return effort == Effort::full ? 5 : 1; }

/// The worst of several runs.
template <typename Measure>
double greatest(Effort effort, const Measure& measure) {
  double worst = measure(1);
  for (std::size_t seed = 2; seed <= count_seeds(effort); ++seed)
    worst = std::max(worst, measure(seed));
  return worst;
}

Verdict exit_flow(const Tested& tested, Effort effort) {
  std::vector<ExitRun> runs;
  for (std::size_t seed = 1; seed <= count_seeds(effort); ++seed) {
    runs.push_back(leave_room(tested, seed));
  }
  return criteria::exit_flow(runs);
}

Verdict capacity_drop(const Tested& tested, Effort) {
  double peak = 0;
  for (const double density : {1.2, 1.5, 1.8, 2.1}) {
    peak = std::max(peak, walk_in_ring(tested, density, 1).speed_mps * density);
  }
  const double dense = walk_in_ring(tested, 3, 1).speed_mps * 3;
  const double packed = walk_in_ring(tested, 5.5, 1).speed_mps * 5.5;
  return criteria::capacity_drop(peak, dense, packed);
}

Verdict open_square(const Tested& tested, Effort effort) {
  const auto stuck = [&](double density) {
    return greatest(effort,
                    [&](std::uint64_t seed) { return cross_square(tested, density, seed).stuck; });
  };
  return criteria::open_square(stuck(0.5), stuck(1));
}

Verdict against_each_other(const Tested& tested, Effort effort) {
  const CounterRun alone = pass_corridor(tested, 0, 1);
  std::vector<CounterRun> against;
  for (std::size_t seed = 1; seed <= count_seeds(effort); ++seed) {
    against.push_back(pass_corridor(tested, 100, seed));
  }
  return criteria::counter_flow(alone, against);
}

Verdict both_ways(const Tested& tested, Effort effort) {
  std::vector<TwoWayRun> runs;
  for (std::size_t seed = 1; seed <= count_seeds(effort); ++seed) {
    runs.push_back(walk_both_ways(tested, 0.75, seed));
  }
  return criteria::two_way(runs, 0.75);
}

Verdict around_corner(const Tested& tested, Effort) {
  std::vector<criteria::CornerFlow> flows;
  for (const double width_m : {2.0, 4.0}) {
    flows.push_back({corridor_flow(tested, {width_m, Turn::none}, 1),
                     corridor_flow(tested, {width_m, Turn::block}, 1),
                     corridor_flow(tested, {width_m, Turn::thin}, 1)});
  }
  return criteria::corner_flow(flows);
}

Verdict evasion(const Tested& tested, Effort) { return criteria::evasion(meet(tested, 0.3, 1)); }

Verdict calm(const Tested& tested, Effort effort) {
  std::vector<CalmRun> runs = {watch(tested, WatchedScene::queue, 1)};
  if (effort == Effort::full) {
    for (const auto scene :
         {WatchedScene::sparse_square, WatchedScene::open_square, WatchedScene::counter_flow}) {
      runs.push_back(watch(tested, scene, 1));
    }
  }
  return criteria::calm(runs);
}

Verdict same_capacity(const Tested& tested, Effort effort) {
  std::vector<double> capacities;
  for (const double width_m : {1.2, 1.8, 3.0, 6.0}) {
    double capacity = 0;
    for (const double density : {1.1, 1.4, 1.7, 2.0}) {
      if (effort == Effort::reduced && density != 1.4) continue;
      const DensitySpeed walk = walk_in_ring(tested, density, 1, {.width_m = width_m});
      capacity = std::max(capacity, density * walk.speed_mps);
    }
    capacities.push_back(capacity);
  }
  return criteria::same_capacity(capacities);
}

Verdict queue(const Tested& tested, Effort) { return criteria::queue(stand_in_queue(tested, 1)); }

}  // namespace

std::vector<Test> walking_tests() {
  return {
      {"imo_4", "IMO 4, NIST 5.2",
       "100 people from a room of 8 m x 5 m through an exit of 1 m; the fastest of 5 runs",
       "at most 1.33 /s over the entire time; all out", exit_flow},
      {"capacity_drop", "Capacity drop",
       "ring of 3 m x 79 m: the greatest flow from 1.2 to 2.1 /m², then 3 and 5.5 /m²",
       "ours: at 3 /m² at most 70 % of the greatest, at 5.5 /m² below 0.5 /(m s)", capacity_drop},
      {"width", "Widths",
       "rings of 79 m that are 1.2, 1.8, 3 and 6 m wide: the greatest flow from 1.1 to 2 /m²",
       "ours: the same within 10 %", same_capacity},
      {"open_square", "Open square",
       "0.5 and 1 people/m² on 30 m x 30 m who walk to random positions; the worst of 5 runs",
       "ours: after 2 minutes at most 2 % get less than 1 m far in 10 s", open_square},
      {"against", "Counter-flow",
       "NIST 2.8 to its end: 100 people alone, then against 100; the slowest of 5 runs",
       "ours: all get across, in at most 2.5 times the time", against_each_other},
      {"two_way", "Two-way corridor",
       "4 m wide; 0.75 /(m s) come in at each end, for 10 minutes; the worst of 5 runs",
       "ours: at least 75 % of them come out at the other; at most 2 % get less than 1 m far in "
       "the "
       "last 10 s",
       both_ways},
      {"corner", "Corner",
       "corridors 2 m and 4 m wide: straight, and with a turn by 90° around a block and around "
       "thin "
       "walls",
       "ours: at least 85 % of the straight flow", around_corner},
      {"evasion", "Evasion", "two people who walk towards each other, 0.3 m aside",
       "ours: they do not touch; begins 2 s before they meet, at most 1 m/s²", evasion},
      {"calm", "Calm",
       "the queue below, the open squares, the counter-flow: the worst of each from 20 to 60 s",
       "ours: less than one turn by more than 90° per person and minute; people slower than 0.2 "
       "m/s "
       "turn at less than 30°/s (root mean square); bodies never overlap by more than 2 cm",
       calm},
      {"queue", "Queue", "150 people before a door of 0.8 m, from 20 to 60 s",
       "ours: less than one turn of the heading by more than 90° per person and minute", queue},
  };
}

}  // namespace throng::validation
