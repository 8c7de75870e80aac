// Content of an OpenStreetMap extract, in meters.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "world/imports/parts/areas.h"
#include "world/imports/parts/imported_scenario.h"
#include "world/scenario.h"

namespace throng::imports {

struct GeoPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
};

using Tags = std::map<std::string, std::string>;

struct OsmPoint {
  std::int64_t id = 0;
  Tags tags;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

struct OsmLine {
  std::int64_t id = 0;
  Tags tags;
  std::vector<Eigen::Vector2d> points;
  std::vector<std::int64_t> nodes;  ///< one per point
};

/// A closed way or a multipolygon.
struct OsmArea {
  std::string name;  ///< "way 12", "relation 3"
  Tags tags;
  Area area;
};

struct OsmFile {
  world::Rectangle bounds;  ///< as the file says, else of its nodes
  bool has_bounds = false;  ///< the file says
  std::vector<OsmPoint> points;
  std::vector<OsmLine> lines;
  std::vector<OsmArea> areas;
  std::vector<Skipped> skipped;
};

/// Reads OSM XML by libosmium, all that has tags. x is east and y north of the origin (default: the
/// middle of the bounds), by the ellipsoid's radii of curvature there: over 3 km off by less than a
/// meter. Rings that cross themselves are repaired(); those
/// that do not close, and what is not whole in the file, are in `skipped`. Objects that JOSM marks
/// as deleted is not there; a multipolygon without tags has those of its outer ways. Throws
/// InputError for what is no such file, spans more than 5 km, or has more than 2 million nodes, and
/// EnvironmentError.
OsmFile read_osm_file(const std::filesystem::path& file, const std::optional<GeoPoint>& origin);

}  // namespace throng::imports
