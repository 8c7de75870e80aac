// The buildings of a map: their outlines and, if mapped, their parts
// (wiki.openstreetmap.org/wiki/Simple_3D_Buildings).
#pragma once

#include <string>
#include <vector>

#include "places/imports/osm/osm_file.h"
#include "places/imports/osm/osm_looks.h"
#include "places/imports/parts/areas.h"
#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// A prism that is rendered.
struct BuildingPiece {
  std::string name;
  Area area;
  double from_m = 0;
  double to_m = 0;
  bool stands = true;  ///< on the ground or on such pieces; else people can walk below
  bool part = false;   ///< part of a building whose outline blocks people
  BuildingLooks looks = {};
};

/// All buildings of a map.
struct MapBuildings {
  std::vector<BuildingPiece> pieces;
  std::vector<Area> outlines;  ///< obstacles for people that are not rendered
  std::vector<Skipped> skipped;
};

/// Whether an area is a building, or a part of one.
bool is_building(const Tags& tags);
bool is_building_part(const Tags& tags);

/// Makes pieces of the areas that are buildings or building parts; `file` is for messages. A
/// building is represented by the parts that lie in it by half or more, if there are any; parts
/// without heights have the building's. If they leave more than half of it bare, the rest stands
/// at the building's own height. Sizes that cannot be read are listed. The highest piece of a
/// building comes first, since it is the visible one where pieces overlap on the ground.
MapBuildings make_buildings(const std::vector<OsmArea>& areas, const std::string& file);

}  // namespace throng::imports
