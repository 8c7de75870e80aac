// The ground of an imported world, and how far the scenario reaches.
#pragma once

#include <string>
#include <vector>

#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// A flat body on the ground, with the height that decides which lies on top.
struct FlatArea {
  double z = 0;
  Corners corners;
  std::string material;
};

/// Lets the scenario reach as far as what stands in it (`reached`), or 8 m farther where that is
/// filled, and lays the flat bodies on its ground. Adds to `place.skipped`, with this file. Throws
/// InputError for a world more than 3 km wide.
void lay_ground(const std::string& file, world::Rectangle reached, std::vector<FlatArea> flat,
                ImportedScenario& place);

}  // namespace throng::imports
