#include "world/trace.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/error.h"

namespace throng::world {

bool implies_lying(std::string_view state_name) {
  std::string lower(state_name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 10> kWords = {
      "fallen",  "incapacitated", "dead",  "unconscious", "collapsed",
      "fainted", "casualty",      "lying", "trampled",    "killed"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

std::vector<bool> TraceHeader::lying_states() const {
  if (!state_lying.empty()) return {state_lying.begin(), state_lying.end()};
  std::vector<bool> lying;
  for (const std::string& name : state_names) lying.push_back(implies_lying(name));
  return lying;
}

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
  const auto between = [s](const auto& from, const auto& to) { return from + s * (to - from); };
  DroneSample sample;
  sample.time_s = time;
  sample.position = between(a.position, b.position);
  sample.velocity = between(a.velocity, b.velocity);
  sample.orientation = a.orientation.slerp(s, b.orientation);
  sample.body_rates = between(a.body_rates, b.body_rates);
  sample.specific_force = between(a.specific_force, b.specific_force);
  sample.air_velocity = between(a.air_velocity, b.air_velocity);
  sample.energy_j = between(a.energy_j, b.energy_j);
  return sample;
}

}  // namespace throng::world
