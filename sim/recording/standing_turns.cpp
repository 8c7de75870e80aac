#include "sim/recording/standing_turns.h"

#include <algorithm>
#include <cmath>

#include "base/compute/random.h"

namespace throng::sim {

void StandingTurns::choose(std::size_t agent, double time_s) {
  constexpr std::uint64_t kFirst = 1U << 20U;  // the animation draws from those before
  Stance& stance = stances_[agent];
  Random random(derive_seed(seed_, Stream::motion, agent), Stream::motion,
                kFirst + stance.choices++);
  // The first one only says when, so that a crowd that stops does not turn all at once.
  const double draw = stance.choices == 1 ? 1 : random.uniform();
  const bool is_aside = stance.wanted_rad != 0;
  stance.wanted_rad = is_aside || draw > 0.6 ? 0 : (draw < 0.3 ? 1.0F : -1.0F) * kStandingTurnRad;
  stance.change_s = time_s + random.uniform(4, 18);
}

void StandingTurns::turn(world::CrowdStep& step, const std::vector<world::AgentRole>& roles) {
  constexpr float kStandsMps = 0.1F;
  constexpr double kStandsAfterS = 2;
  constexpr double kTurnS = 1.2;
  constexpr double kTurnWalkingS = 0.5;
  stances_.resize(step.position.size());
  const double dt_s = step.time_s - before_s_;
  before_s_ = step.time_s;
  // Whole steps: the last part of a turn would be too slow for feet to step with it.
  const auto turned_in = [&](double turn_s) {
    return dt_s > 0
               ? kStandingTurnRad / static_cast<float>(std::max(1L, std::lround(turn_s / dt_s)))
               : 0.0F;
  };
  const float slow = turned_in(kTurnS);
  const float fast = turned_in(kTurnWalkingS);
  for (std::size_t i = 0; i < stances_.size(); ++i) {
    Stance& stance = stances_[i];
    if (roles[i] != world::AgentRole::person) continue;
    const bool there = (step.flags[i] & world::kPresent) != 0;
    const bool moves = !there || step.velocity[i].squaredNorm() > kStandsMps * kStandsMps;
    if (moves) stance.moved_s = step.time_s;
    if ((step.flags[i] & world::kFallen) == 0) {
      const bool is_calm = (step.flags[i] & world::kPanicked) == 0;
      if (!is_calm || step.time_s - stance.moved_s < kStandsAfterS) {
        stance.wanted_rad = 0;
      } else if (step.time_s >= stance.change_s) {
        choose(i, step.time_s);
      }
      const float most = moves ? fast : slow;
      stance.aside_rad += std::clamp(stance.wanted_rad - stance.aside_rad, -most, most);
    }
    step.yaw_rad[i] = geometry::wrapped_rad(step.yaw_rad[i] + stance.aside_rad);
  }
}

}  // namespace throng::sim
