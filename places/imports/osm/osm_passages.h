// Ways below buildings: passages to courtyards, arcades and colonnades.
#pragma once

#include <string>
#include <vector>

#include "places/imports/osm/osm_file.h"
#include "places/imports/parts/areas.h"

namespace throng::imports {

/// A way that people walk below a building.
struct Passage {
  std::string name;          ///< "way 12"
  std::vector<Area> ground;  ///< as wide as the way, at least 2 m
  double clear_m = 3;        ///< height of the lower side of the building above it
};

/// Whether a way passes below a building: `tunnel=building_passage`, or `covered` by one.
bool is_passage(const Tags& tags);

/// The passages among the ways that people use. Their heights are `maxheight` or `height`, else
/// 3 m. Each reaches half a meter beyond its ends, which may lie somewhat within the building.
std::vector<Passage> find_passages(const std::vector<OsmLine>& lines);

}  // namespace throng::imports
