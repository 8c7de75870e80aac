// Orientation of standing people: towards a stage, along a platform, any.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "crowd/elements/registry.h"

namespace throng::crowd {

/// The <Facing> of an <AgentGroup>. It holds for those who stand when they begin, until
/// their state changes; walking agents face along their path.
class Facing {
 public:
  virtual ~Facing() = default;
  /// The direction (unit) of an agent at its place. It depends on the run's seed and the agent's
  /// number only.
  virtual Eigen::Vector2f direction(std::size_t agent, const Eigen::Vector2f& place) const = 0;
};

/// Inputs of a Facing's factory.
struct FacingContext {
  std::uint64_t seed = 1;
};

using FacingRegistry = Registry<Facing, FacingContext>;
/// random, direction, towards.
const FacingRegistry& facing_registry();

/// Any direction, by the seed: where a group does not say.
std::unique_ptr<Facing> any_facing(std::uint64_t seed);

}  // namespace throng::crowd
