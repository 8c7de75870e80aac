// Import of OpenStreetMap extracts as scenarios.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "places/imports/osm/osm_file.h"
#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// Options of read_osm().
struct OsmOptions {
  std::optional<GeoPoint> origin;  ///< default: the center of the bounds
  std::vector<Gate> gates;         ///< exits; empty: where ways leave the extract
};

/// Reads an extract: buildings with their heights (also multipolygons; people pass below parts that
/// start above 2 m), ways with their widths, crossings, green and paved areas, water, barriers with
/// gates, trees, lamps, benches, bins and bollards. Ways have gates where they leave the bounds,
/// whose shares of the people are proportional to the widths, with a factor of 1 for footways and
/// 0.3 for roads. ImportedScenario::skipped lists the rest. Throws as read_osm_file().
ImportedScenario read_osm(const std::filesystem::path& file, const OsmOptions& options);

}  // namespace throng::imports
