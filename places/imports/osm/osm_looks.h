// The looks of buildings in OpenStreetMap: facades, colors and roofs, by the tags of Simple 3D
// Buildings (wiki.openstreetmap.org/wiki/Simple_3D_Buildings).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "places/imports/osm/osm_file.h"
#include "world/building.h"

namespace throng::imports {

struct BuildingLooks {
  world::Facade facade = world::Facade::by_id;
  std::optional<world::Paint> paint = std::nullopt;
  world::Roof roof = {};
};

/// Looks as `building:material`, `building:colour` and `roof:*` say them. `roof_m` is the height
/// of the roof that the building's sizes include, if they say one.
BuildingLooks building_looks(const Tags& tags, std::optional<double> roof_m);

/// The tags ("roof:shape=onion") about looks that are not drawn as they say.
std::vector<std::string> undrawn_looks(const Tags& tags);

/// Gives a part those tags about looks that it lacks and its building has.
void inherit_looks(const Tags& building, Tags& part);

}  // namespace throng::imports
