#include "annotate/rasters/trajectories.h"

#include <array>
#include <limits>

#include "annotate/rasters/density.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

std::array<float, kTrajectoryValues> trajectory_values(const world::Trace& trace,
                                                       const world::BetweenSteps& at,
                                                       std::size_t agent) {
  if (!trace.present(at.before, agent)) {
    constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
    return {kAbsent, kAbsent, kAbsent, kAbsent};
  }
  const Eigen::Vector2f place = trace.position_at(at, agent);
  const std::uint8_t state = trace.state.empty() ? 0 : trace.state[trace.at(at.before, agent)];
  return {place.x(), place.y(), trace.yaw_at(at, agent), static_cast<float>(state)};
}

}  // namespace

Trajectories trajectories_at(const world::Trace& trace, std::span<const double> times_s) {
  check(trace.steps() > 0, "a trace that is measured has steps");
  Trajectories found;
  found.frames = times_s.size();
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (!world::is_visible_person(trace.header.role[agent])) continue;
    found.agents.push_back(static_cast<std::uint32_t>(agent));
  }
  found.values.reserve(times_s.size() * found.agents.size() * kTrajectoryValues);
  for (const double time_s : times_s) {
    const world::BetweenSteps at = trace.steps_around(time_s);
    for (const std::uint32_t agent : found.agents) {
      const auto values = trajectory_values(trace, at, agent);
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
