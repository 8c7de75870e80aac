// Where a group's agents start.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/menge_random.h"
#include "crowd/registry.h"
#include "crowd/shared_parts.h"

namespace throng::crowd {

/// Agents in a scene; more is taken for a mistake.
constexpr std::size_t kMostAgents = 4'000'000;

/// What a <Generator> makes: places, each with its noise still to be added.
class Generator {
 public:
  virtual ~Generator() = default;
  virtual std::size_t count() const = 0;
  /// The place of the index-th agent, moved by `noise` in the generator's own frame.
  virtual Eigen::Vector2f place(std::size_t index, const Eigen::Vector2f& noise) const = 0;
};

struct GeneratorContext {
  SharedParts& parts;
};
using GeneratorRegistry = Registry<Generator, GeneratorContext>;
/// explicit, rect_grid, hex_lattice, nav_mesh_explicit.
const GeneratorRegistry& generator_registry();

/// The places of a <Generator>'s agents; `first_agent` is the id of the first of them. Compatible
/// runs draw the noise from `sequences`.
std::vector<Eigen::Vector2f> generate_places(const Element& element, std::uint64_t seed,
                                             MengeSequences& sequences, SharedParts& parts,
                                             std::size_t first_agent);

}  // namespace throng::crowd
