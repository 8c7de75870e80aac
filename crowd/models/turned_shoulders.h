// People who get no further turn their shoulders: their bodies take less room until they have
// passed. Without that, discs that press towards a door form arches, and oncoming crowds lock.
#pragma once

#include <span>
#include <vector>

namespace throng::crowd {

/// The breadths of all agents, by agent: shares of their radii.
class TurnedShoulders {
 public:
  /// `min_breadth` is the share of the radius of a body that is turned entirely; 1: nobody turns.
  TurnedShoulders(std::size_t agent_count, float min_breadth);

  /// Turns an agent that has got less far than it wanted to: `progress_mps` along its path instead
  /// of `wished_mps`. Different agents may be updated by several threads.
  void update(std::size_t agent, float progress_mps, float wished_mps, float dt_s);

  std::span<const float> breadths() const { return breadths_; }
  /// How far an agent is turned: 0 not at all, 1 entirely.
  float turned(std::size_t agent) const;

 private:
  float min_breadth_;
  std::vector<float> breadths_;
  std::vector<float> blocked_s_;
};

}  // namespace throng::crowd
