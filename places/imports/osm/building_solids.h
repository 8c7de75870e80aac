// Puts the buildings of a map into a scenario: those that stand, those that people walk below, and
// passages through them.
#pragma once

#include <string>
#include <vector>

#include "base/geometry/rectangle.h"
#include "places/imports/osm/osm_buildings.h"
#include "places/imports/osm/osm_passages.h"
#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

class BuildingSolids {
 public:
  /// `place` is what the buildings are added to; `source` names the file in `place.skipped`.
  BuildingSolids(ImportedScenario& place, std::string source, std::vector<Passage> passages);

  /// Adds all buildings, the highest piece of each first. The later one of two that overlap is
  /// cut; one that a passage leads through stands above the passage only.
  void add(const MapBuildings& buildings);

 private:
  void skip(const std::string& element, const std::string& reason) {
    place_.skipped.push_back({source_, 0, element, reason});
  }
  void block(const Area& outline);
  void add_standing(const BuildingPiece& piece);
  bool add_hanging(const BuildingPiece& piece);
  void stand(const BuildingPiece& piece, const Area& area);
  std::vector<Area> opened(const BuildingPiece& piece, const Area& area);

  ImportedScenario& place_;
  std::string source_;
  std::vector<Passage> passages_;
  std::vector<geometry::Rectangle> passage_bounds_;
  std::vector<geometry::Rectangle> building_bounds_;
};

}  // namespace throng::imports
