// Recordings of people who walk straight, made for the tests.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "world/trace.h"

namespace throng::sim::testing {

struct RecordedWalk {
  std::size_t first;  ///< frame
  std::size_t last;   ///< frame
  Eigen::Vector2d from;
  Eigen::Vector2d velocity;  ///< m/s
};

inline std::shared_ptr<const world::Trace> make_recording(double dt_s, std::size_t frames,
                                                          const std::vector<RecordedWalk>& walks) {
  auto trace = std::make_shared<world::Trace>();
  trace->header.dt_s = dt_s;
  trace->header.role.assign(walks.size(), world::AgentRole::person);
  trace->header.radius_m.assign(walks.size(), 0.2F);
  trace->header.pref_speed_mps.assign(walks.size(), 1.3F);
  trace->header.group.assign(walks.size(), -1);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    trace->time_s.push_back(static_cast<double>(frame) * dt_s);
    for (const RecordedWalk& walk : walks) {
      const double since_s = (static_cast<double>(frame) - static_cast<double>(walk.first)) * dt_s;
      const bool there = frame >= walk.first && frame <= walk.last;
      trace->position.emplace_back((walk.from + since_s * walk.velocity).cast<float>());
      trace->velocity.emplace_back(walk.velocity.cast<float>());
      trace->flags.push_back(there ? world::kPresent : std::uint8_t{0});
    }
  }
  return trace;
}

}  // namespace throng::sim::testing
