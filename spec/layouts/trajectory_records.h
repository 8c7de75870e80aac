// Binary records in the answer of GET /v1/jobs/{id}/runs/{n}/trajectories (docs/api.md): the head,
// the times as float64, the agents' roles as uint8, then for each time a record of each agent.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "spec/layouts/binary_field.h"

namespace throng::layouts {

inline constexpr std::uint32_t kTrajectoriesVersion = 1;

struct TrajectoriesHead {
  std::uint32_t version = kTrajectoriesVersion;
  std::uint32_t times = 0;
  std::uint32_t agents = 0;
  std::array<float, 2> origin{};  ///< of the positions, m
  float step_m = 0;               ///< in which positions are counted from the origin
};
inline constexpr std::array kTrajectoriesHeadFields = {
    field("version", &TrajectoriesHead::version), field("times", &TrajectoriesHead::times),
    field("agents", &TrajectoriesHead::agents), field("origin", &TrajectoriesHead::origin),
    field("step_m", &TrajectoriesHead::step_m)};
static_assert(fill(kTrajectoriesHeadFields, sizeof(TrajectoriesHead)));

struct TrajectoryRecord {
  std::array<std::uint16_t, 2> position{};  ///< in steps; kAbsent: the agent takes no part
  std::uint8_t state = 0;
  std::uint8_t flags = 0;  ///< world::kPresent and the like
};
inline constexpr std::uint16_t kAbsent = std::numeric_limits<std::uint16_t>::max();
inline constexpr std::array kTrajectoryFields = {field("position", &TrajectoryRecord::position),
                                                 field("state", &TrajectoryRecord::state),
                                                 field("flags", &TrajectoryRecord::flags)};
static_assert(fill(kTrajectoryFields, sizeof(TrajectoryRecord)));

}  // namespace throng::layouts
