// A Menge scene file: who is there, where, and which walls.
#pragma once

#include <string>
#include <vector>

#include "crowd/behavior.h"
#include "crowd/crowd.h"
#include "crowd/elements/attributes.h"
#include "crowd/elements/element.h"
#include "crowd/elements/menge_random.h"
#include "crowd/model.h"

namespace throng::crowd {

/// Parts that cannot be made before the behavior file is read.
struct Scene {
  std::vector<std::vector<Element>> profile_modifiers;  ///< the <VelModifier>s of each profile
  std::vector<std::unique_ptr<Process>> processes;      ///< arrivals
  std::vector<std::unique_ptr<VelModifier>> modifiers;  ///< social groups; before the file's own
};

/// The attributes of <SpatialQuery>.
AttributeTable spatial_query_attributes();

/// Reads an <Experiment> into `crowd`, whose seed and compat are set: time step, obstacles and
/// agents with their properties, positions and first states. Throws InputError.
Scene load_scene(const Element& experiment, const std::vector<std::string>& state_names,
                 const ModelEntry& model, MengeSequences& sequences, Crowd& crowd);

}  // namespace throng::crowd
