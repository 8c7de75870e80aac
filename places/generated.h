// Generated places as scenarios, without anybody having to keep their files.
#pragma once

#include "places/generate.h"
#include "world/scenario.h"

namespace throng::places {

/// The scenario of a spec; its id is scenario_id_of(spec). Nothing is written: its crowd is
/// Scenario::built_crowd.
world::Scenario load_generated(const PlaceSpec& spec);

}  // namespace throng::places
