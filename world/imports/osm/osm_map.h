// OpenStreetMap extracts as points.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "world/imports/osm/osm_file.h"
#include "world/imports/parts/imported_scenario.h"

namespace throng::imports {

struct OsmOptions {
  std::optional<GeoPoint> origin;  ///< default: the middle of the bounds
  std::vector<Gate> gates;         ///< exits; empty: where ways leave the extract
};

/// Reads an extract: buildings with their heights (multipolygons too; parts that begin above 2 m
/// are drawn, and people pass below), ways by their widths, crossings, areas of green and of
/// paving, water, barriers with the gates in them, trees, lamps, benches, bins and bollards. Ways
/// that leave the bounds have gates there, shared by their widths, a footway counting in full
/// and a road as three tenths. The rest is listed in ImportedScenario::skipped. Throws as
/// read_osm_file().
ImportedScenario read_osm(const std::filesystem::path& file, const OsmOptions& options);

}  // namespace throng::imports
