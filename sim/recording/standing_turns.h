// People who stand turn their bodies now and then.
#pragma once

#include <cstdint>
#include <vector>

#include "base/geometry/angle.h"
#include "world/trace.h"

namespace throng::sim {

/// Turns people who have stood for some seconds aside by kStandingTurnRad, and back: at other times
/// for each, by the seed. People who walk on, or panic, face where the crowd engine says. Headings
/// in a trace, not the crowd's own, so that nobody takes another way.
class StandingTurns {
 public:
  explicit StandingTurns(std::uint64_t seed) : seed_(seed) {}

  /// Turns the people of the next step.
  void turn(world::CrowdStep& step, const std::vector<world::AgentRole>& roles);

 private:
  struct Stance {
    float aside_rad = 0;
    float wanted_rad = 0;
    double moved_s = 0;   ///< when the person last moved
    double change_s = 0;  ///< when wanted_rad is chosen again
    std::uint32_t choices = 0;
  };
  void choose(std::size_t agent, double time_s);

  std::uint64_t seed_;
  double before_s_ = 0;
  std::vector<Stance> stances_;
};

/// As far as people turn with one step of each foot.
inline constexpr float kStandingTurnRad = static_cast<float>(30 * kDegree);

}  // namespace throng::sim
