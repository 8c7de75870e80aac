// Places from a seed: blueprints that are always valid.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "spec/places/place_spec.h"

namespace throng::places {

/// The blueprint of such a place: every walkable point reaches an exit, nobody starts in anything
/// solid and people come in by every exit. The same spec gives the same blueprint.
nlohmann::json generate_place(const PlaceSpec& spec);

}  // namespace throng::places
