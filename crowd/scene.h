// A Menge scene file: who is there, where, and which walls.
#pragma once

#include <string>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/model.h"
#include "crowd/xml.h"

namespace throng::crowd {

/// Reads an <Experiment> into `crowd`: time step, obstacles and agents with their properties,
/// positions and first states. Throws InputError.
void load_scene(const Element& experiment, const std::vector<std::string>& state_names,
                const ModelEntry& model, std::uint64_t seed, Crowd& crowd);

}  // namespace throng::crowd
