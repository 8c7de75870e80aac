// Initial positions of a group's agents.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/elements/menge_random.h"
#include "crowd/elements/registry.h"

namespace throng::crowd {

/// Agents in a scene; more is taken for a mistake.
constexpr std::size_t kMaxAgents = 4'000'000;

/// A <Generator>: initial positions, before their noise is added.
class Generator {
 public:
  virtual ~Generator() = default;
  virtual std::size_t count() const = 0;
  /// The place of the index-th agent, moved by `noise` in the generator's own frame.
  virtual Eigen::Vector2f place(std::size_t index, const Eigen::Vector2f& noise) const = 0;
};

/// Objects that exist before a generator makes positions.
struct GeneratorContext {
  const Crowd& crowd;  ///< its walls, and the people who have places already
  std::uint64_t seed = 1;
  std::size_t first_agent = 0;  ///< id of the first agent who gets a place
};
using GeneratorRegistry = Registry<Generator, GeneratorContext>;
/// explicit, rect_grid, hex_lattice, nav_mesh_explicit, scatter.
const GeneratorRegistry& generator_registry();

/// The places of a <Generator>'s agents. Compatible runs draw the noise from `sequences`.
std::vector<Eigen::Vector2f> generate_positions(const Element& element, GeneratorContext context,
                                                MengeSequences& sequences);

}  // namespace throng::crowd
