// Our own tests of flows: those that decide whether evacuation times can be believed.
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
      {"passages", "Passages", "the same, 4 m long", "specific flows 1.2 to 2.3 /(m s)",
       [](const Tested& tested, Effort effort) { return doors(tested, 4, effort); }},
  };
}

}  // namespace throng::validation
