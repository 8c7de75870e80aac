// Buildings of a map: their outlines, and the parts that they are drawn by where they have some
// (wiki.openstreetmap.org/wiki/Simple_3D_Buildings).
#pragma once

#include <string>
#include <vector>

#include "world/imports/osm/osm_file.h"
#include "world/imports/parts/areas.h"
#include "world/imports/parts/imported_scenario.h"

namespace throng::imports {

/// A prism that is drawn.
struct BuildingPiece {
  std::string name;
  Area area;
  double from_m = 0;
  double to_m = 0;
  bool stands = true;  ///< on the ground, or on pieces that do; else people walk below
  bool part = false;   ///< of a building whose outline blocks people
};

struct MapBuildings {
  std::vector<BuildingPiece> pieces;
  std::vector<Area> outlines;  ///< where nobody walks though nothing of these is drawn
  std::vector<Skipped> skipped;
};

/// Whether an area is a building, or a part of one.
bool is_building(const Tags& tags);
bool is_building_part(const Tags& tags);

/// The areas that are buildings or parts of them. A building is drawn by its parts, if
/// half of a part or more lies in it; parts without heights have the building's. Pieces of one
/// building come with the highest first: where they overlap on the ground, it is what one sees.
MapBuildings make_buildings(const std::vector<OsmArea>& areas, const std::string& file);

}  // namespace throng::imports
