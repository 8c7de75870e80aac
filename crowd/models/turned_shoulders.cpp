#include "crowd/models/turned_shoulders.h"

#include <algorithm>

namespace throng::crowd {

namespace {

constexpr float kBlocked = 0.3F;           // share of the wished speed: slower people are blocked
constexpr float kMinWishMps = 0.2F;        // slower people wait
constexpr float kBlockedPatienceS = 0.3F;  // of being blocked before one turns
constexpr float kTurningS = 0.4F;          // from the full breadth to the smallest
constexpr float kBlockedForgetting = 2;    // how fast blocked time counts down

}  // namespace

TurnedShoulders::TurnedShoulders(std::size_t agent_count, float min_breadth)
    : min_breadth_(min_breadth), breadths_(agent_count, 1.0F), blocked_s_(agent_count, 0.0F) {}

void TurnedShoulders::update(std::size_t agent, float progress_mps, float wished_mps, float dt_s) {
  const bool blocked = wished_mps > kMinWishMps && progress_mps < kBlocked * wished_mps;
  const float change = (1 - min_breadth_) * dt_s / kTurningS;
  float& breadth = breadths_[agent];
  float& time_s = blocked_s_[agent];
  if (!blocked) {
    time_s = std::max(0.0F, time_s - kBlockedForgetting * dt_s);
    breadth = std::min(1.0F, breadth + change);
    return;
  }
  time_s = std::min(time_s + dt_s, 2 * kBlockedPatienceS);
  if (time_s > kBlockedPatienceS) breadth = std::max(min_breadth_, breadth - change);
}

float TurnedShoulders::turned(std::size_t agent) const {
  return min_breadth_ < 1 ? (1 - breadths_[agent]) / (1 - min_breadth_) : 0;
}

}  // namespace throng::crowd
