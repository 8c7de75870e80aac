// Orientation of standing people: towards a stage, along a platform, or random.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "crowd/elements/registry.h"

namespace throng::crowd {

/// The <Facing> of an <AgentGroup>. Applies to agents that stand at the start, until their state
/// changes; walking agents face along their path.
class Facing {
 public:
  virtual ~Facing() = default;
  /// Returns the direction (unit vector) of an agent at its position. Depends only on the position,
  /// the seed of the run and the id of the agent.
  virtual Eigen::Vector2f direction(std::size_t agent, const Eigen::Vector2f& place) const = 0;
};

/// Inputs of the factories of Facing.
struct FacingContext {
  std::uint64_t seed = 1;
};

using FacingRegistry = Registry<Facing, FacingContext>;
/// Types: random, direction, towards.
const FacingRegistry& facing_registry();

/// Returns random directions, for groups without a <Facing>.
std::unique_ptr<Facing> any_facing(std::uint64_t seed);

}  // namespace throng::crowd
