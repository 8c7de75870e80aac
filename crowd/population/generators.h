// Initial positions of a group's agents.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/elements/menge_sequences.h"
#include "crowd/elements/registry.h"
#include "crowd/state/crowd.h"

namespace throng::crowd {

/// Max number of agents in a scene; a greater number is considered a mistake.
constexpr std::size_t kMaxAgents = 4'000'000;

/// A <Generator> of initial positions.
class Generator {
 public:
  virtual ~Generator() = default;
  virtual std::size_t count() const = 0;
  /// Returns the position of the index-th agent, displaced by `noise` in the generator's frame.
  virtual Eigen::Vector2f place(std::size_t index, const Eigen::Vector2f& noise) const = 0;
};

/// Inputs of the factories of generators.
struct GeneratorContext {
  const Crowd& crowd;  ///< with its walls and the agents that already have positions
  std::uint64_t seed = 1;
  std::size_t first_agent = 0;  ///< id of the first agent to place
};
using GeneratorRegistry = Registry<Generator, GeneratorContext>;
/// Types: explicit, rect_grid, hex_lattice, nav_mesh_explicit, scatter.
const GeneratorRegistry& generator_registry();

/// Returns the positions of a <Generator>'s agents. In compatible runs, noise comes from
/// `sequences`.
std::vector<Eigen::Vector2f> generate_positions(const Element& element, GeneratorContext context,
                                                MengeSequences& sequences);

}  // namespace throng::crowd
