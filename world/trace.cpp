#include "world/trace.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "base/text/words.h"

namespace throng::world {

bool implies_lying(std::string_view state_name) {
  const std::string lower = lower_case(state_name);
  constexpr std::array<std::string_view, 10> kWords = {
      "fallen",  "incapacitated", "dead",  "unconscious", "collapsed",
      "fainted", "casualty",      "lying", "trampled",    "killed"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

std::optional<std::size_t> find_stand_states(const std::vector<std::string>& state_names) {
  if (state_names.size() < kStandStates.size()) return std::nullopt;
  const std::size_t first = state_names.size() - kStandStates.size();
  const auto names = state_names.begin() + static_cast<std::ptrdiff_t>(first);
  if (!std::equal(kStandStates.begin(), kStandStates.end(), names)) return std::nullopt;
  return first;
}

std::vector<bool> TraceHeader::lying_states() const {
  if (!state_lying.empty()) return {state_lying.begin(), state_lying.end()};
  std::vector<bool> lying;
  for (const std::string& name : state_names) lying.push_back(implies_lying(name));
  return lying;
}

BetweenSteps Trace::steps_around(double time) const {
  check(!time_s.empty(), "a trace has steps");
  const auto next = std::upper_bound(time_s.begin(), time_s.end(), time + kTimeSlackS);
  if (next == time_s.begin()) return {};
  const auto before = static_cast<std::size_t>(next - time_s.begin()) - 1;
  if (next == time_s.end()) return {before, before, 0};
  const double share = (time - time_s[before]) / (*next - time_s[before]);
  return {before, before + 1, static_cast<float>(std::max(share, 0.0))};
}

Eigen::Vector2f Trace::position_at(const BetweenSteps& around, std::size_t agent) const {
  const Eigen::Vector2f& from = position[at(around.before, agent)];
  if (around.share == 0 || !present(around.after, agent)) return from;
  return from + around.share * (position[at(around.after, agent)] - from);
}

Eigen::Vector2f Trace::velocity_at(const BetweenSteps& around, std::size_t agent) const {
  const Eigen::Vector2f& before = velocity[at(around.before, agent)];
  if (around.share == 0 || !present(around.after, agent)) return before;
  constexpr float kJumpMps = 12;  // nobody runs as fast
  const auto duration_s = static_cast<float>(time_s[around.after] - time_s[around.before]);
  const Eigen::Vector2f mean =
      (position[at(around.after, agent)] - position[at(around.before, agent)]) / duration_s;
  return mean.norm() < kJumpMps ? mean : before;
}

float Trace::yaw_at(const BetweenSteps& around, std::size_t agent) const {
  const float from = yaw_rad[at(around.before, agent)];
  if (around.share == 0 || !present(around.after, agent)) return from;
  return geometry::interpolated_rad(from, yaw_rad[at(around.after, agent)], around.share);
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
