#include "world/trace.h"

#include <algorithm>

#include "base/error.h"

namespace throng::world {

DroneSample Trace::drone_at(std::size_t drone, double time) const {
  check(drone < drones.size() && !drones[drone].empty(), "the trace has samples of this drone");
  const std::vector<DroneSample>& samples = drones[drone];
  const auto after =
      std::upper_bound(samples.begin(), samples.end(), time,
                       [](double t, const DroneSample& sample) { return t < sample.time_s; });
  if (after == samples.begin()) return samples.front();
  if (after == samples.end()) return samples.back();
  const DroneSample& a = *(after - 1);
  const DroneSample& b = *after;
  const double s = (time - a.time_s) / (b.time_s - a.time_s);
  return {time, a.position + s * (b.position - a.position),
          a.velocity + s * (b.velocity - a.velocity), a.orientation.slerp(s, b.orientation)};
}

}  // namespace throng::world
