#include "annotate/trajectories.h"

#include <algorithm>
#include <array>
#include <limits>

#include "annotate/density.h"
#include "base/error.h"
#include "geometry/angle.h"

namespace throng::annotate {

namespace {

/// A time between two steps of a trace.
struct Between {
  std::size_t before = 0;
  std::size_t after = 0;
  float share = 0;  ///< of the way from `before` to `after`
};

Between find(const std::vector<double>& times_s, double time_s) {
  const auto next = std::upper_bound(times_s.begin(), times_s.end(), time_s + world::kTimeSlackS);
  Between at;
  if (next == times_s.begin()) return at;
  at.before = static_cast<std::size_t>(next - times_s.begin()) - 1;
  at.after = std::min(at.before + 1, times_s.size() - 1);
  if (at.after == at.before) return at;
  const double length_s = times_s[at.after] - times_s[at.before];
  at.share = static_cast<float>(std::clamp((time_s - times_s[at.before]) / length_s, 0.0, 1.0));
  return at;
}

std::array<float, kTrajectoryValues> values_of(const world::Trace& trace, const Between& at,
                                               std::size_t agent) {
  if (!trace.present(at.before, agent)) {
    constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
    return {kAbsent, kAbsent, kAbsent, kAbsent};
  }
  const bool leaves = !trace.present(at.after, agent);
  const std::size_t a = trace.at(at.before, agent);
  const std::size_t b = leaves ? a : trace.at(at.after, agent);
  const Eigen::Vector2f place =
      trace.position[a] + at.share * (trace.position[b] - trace.position[a]);
  return {place.x(), place.y(),
          geometry::interpolated_rad(trace.yaw_rad[a], trace.yaw_rad[b], at.share),
          trace.state.empty() ? 0.0F : static_cast<float>(trace.state[a])};
}

}  // namespace

Trajectories trajectories_at(const world::Trace& trace, std::span<const double> times_s) {
  check(trace.steps() > 0, "a trace that is measured has steps");
  Trajectories found;
  found.frames = times_s.size();
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    const world::AgentRole role = trace.header.role[agent];
    if (role != world::AgentRole::person && role != world::AgentRole::attacker) continue;
    found.agents.push_back(static_cast<std::uint32_t>(agent));
  }
  found.values.reserve(times_s.size() * found.agents.size() * kTrajectoryValues);
  for (const double time_s : times_s) {
    const Between at = find(trace.time_s, time_s);
    for (const std::uint32_t agent : found.agents) {
      const auto values = values_of(trace, at, agent);
      found.values.insert(found.values.end(), values.begin(), values.end());
    }
  }
  return found;
}

std::string npy_bytes(const Trajectories& trajectories) {
  return npy_bytes(std::array{static_cast<int>(trajectories.frames),
                              static_cast<int>(trajectories.agents.size()), kTrajectoryValues},
                   trajectories.values);
}

}  // namespace throng::annotate
