#include "world/disasters.h"

#include <algorithm>

namespace throng::world {

double Disaster::reach_m(double time_s) const {
  if (time_s < start_s) return 0;
  return std::min(radius_m + growth_mps * (time_s - start_s), std::max(radius_m, max_radius_m));
}

}  // namespace throng::world
