// Generated places as scenarios, without anybody having to keep their files.
#pragma once

#include "places/generate.h"
#include "world/scenario.h"

namespace throng::places {

/// The scenario of a spec; its id is "generated/" + id_of(spec). Its files are made once per
/// process, in a temporary folder that goes with the process. Throws EnvironmentError when they
/// cannot be written. May be called by several threads.
world::Scenario load_generated(const PlaceSpec& spec);

}  // namespace throng::places
