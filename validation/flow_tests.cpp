// Our own tests of flows: those that decide whether evacuation times can be believed.
#include <algorithm>
#include <limits>
#include <vector>

#include "base/compute/quantile.h"
#include "validation/criteria.h"
#include "validation/flow.h"
#include "validation/suite.h"

namespace throng::validation {

namespace {

Verdict weidmann_diagram(const Tested& tested, Effort effort) {
  const std::vector<double> densities = effort == Effort::full
                                            ? std::vector<double>{0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}
                                            : std::vector<double>{0.5, 2, 4};
  std::vector<DensitySpeed> measured;
  measured.reserve(densities.size());
  for (const double density : densities) measured.push_back(walk_in_ring(tested, density, 1));
  return criteria::weidmann_diagram(measured);
}

Verdict doors(const Tested& tested, double wall_m, Effort effort) {
  const std::vector<double> widths = effort == Effort::full
                                         ? std::vector<double>{0.8, 1.0, 1.2, 1.6, 2.0}
                                         : std::vector<double>{0.8, 2.0};
  std::vector<double> medians;
  for (const double width : widths) {
    const std::uint64_t seeds = effort == Effort::full ? 7 : 3;
    std::vector<double> flows;
    flows.reserve(seeds);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      flows.push_back(specific_flow(tested, {width, wall_m, 150}, seed));
    }
    medians.push_back(median(flows));
  }
  return criteria::specific_flows(medians);
}

/// Flows of doors of one width whose corners, depth and room differ: means over seeds.
criteria::DoorFlows drawn_door(const Tested& tested, double width_m, Effort effort) {
  const bool full = effort == Effort::full;
  const std::uint64_t seeds = full ? 4 : 2;
  criteria::DoorFlows flows{std::numeric_limits<double>::infinity(), 0};
  for (const Bottleneck& door : drawn_doors(width_m, full)) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) sum += specific_flow(tested, door, seed);
    const double flow_per_s = width_m * sum / static_cast<double>(seeds);
    flows.min_per_s = std::min(flows.min_per_s, flow_per_s);
    flows.max_per_s = std::max(flows.max_per_s, flow_per_s);
  }
  return flows;
}

Verdict doors_as_drawn(const Tested& tested, Effort effort) {
  const std::vector<double> widths = effort == Effort::full
                                         ? std::vector<double>{0.5, 0.7, 0.8, 1.0, 1.2}
                                         : std::vector<double>{0.5, 1.0};
  std::vector<criteria::DoorFlows> doors;
  doors.reserve(widths.size());
  for (const double width : widths) doors.push_back(drawn_door(tested, width, effort));
  return criteria::drawn_doors(doors);
}

}  // namespace

std::vector<Test> flow_tests() {
  return {
      {"weidmann", "Fundamental diagram",
       "ring of 3 m x 79 m, 0.5, 1, 1.5, ..., 4 people/m², from 20 to 50 s",
       "mean speeds within 0.2 m/s of Weidmann (1993)", weidmann_diagram},
      {"doors", "Doors",
       "150 people, room of 10 m x 10 m, doors of 0.8, 1.0, 1.2, 1.6, 2.0 m in a wall of 0.2 m; "
       "flow from the 10th to the 80th percentile, medians of 7 runs",
       "specific flows 1.2 to 2.3 /(m s)",
       [](const Tested& tested, Effort effort) { return doors(tested, 0.2, effort); }},
      {"drawn_doors", "Doors as drawn",
       "75 people, doors of 0.5, 0.7, 0.8, 1.0, 1.2 m in walls of 0.1, 0.4, 1.1 m, rooms 1.8, 2.4, "
       "5.6 m wide, corners square or cut by 5, 15, 30 cm; means of 4 runs",
       "ours: flows of a width within 15 % of their middle, which grows with width",
       doors_as_drawn},
      {"passages", "Passages", "the same, 4 m long", "specific flows 1.2 to 2.3 /(m s)",
       [](const Tested& tested, Effort effort) { return doors(tested, 4, effort); }},
  };
}

}  // namespace throng::validation
