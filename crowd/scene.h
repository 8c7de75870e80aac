// Menge's scene files: agents, their profiles and start positions, and obstacles.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "crowd/elements/attributes.h"
#include "crowd/elements/element.h"
#include "crowd/elements/menge_sequences.h"
#include "crowd/state/behavior.h"
#include "crowd/state/crowd.h"
#include "crowd/state/model.h"

namespace throng::crowd {

/// Parts of a scene that are completed after the behavior file has been read.
struct Scene {
  std::vector<std::size_t> first_agents;                ///< of each <AgentGroup>
  std::vector<std::vector<Element>> profile_modifiers;  ///< the <VelModifier>s of each profile
  std::vector<std::unique_ptr<Process>> processes;      ///< arrivals of agents
  /// Modifiers of social groups; they precede those of the behavior file.
  std::vector<std::unique_ptr<VelModifier>> modifiers;
};

/// Returns the attributes of <SpatialQuery>.
AttributeTable spatial_query_attributes();

/// Reads an <Experiment> into `crowd`, whose seed, compat and constants of the model must be set:
/// time step, obstacles, and agents with their properties, positions and initial states. Throws
/// InputError.
Scene load_scene(const Element& experiment, const std::vector<std::string>& state_names,
                 const ModelEntry& model, MengeSequences& sequences, Crowd& crowd);

}  // namespace throng::crowd
