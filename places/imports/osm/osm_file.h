// The content of an OpenStreetMap extract, in meters.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "places/imports/parts/areas.h"
#include "places/imports/parts/imported_scenario.h"
#include "world/scenario.h"

namespace throng::imports {

struct GeoPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
};

using Tags = std::map<std::string, std::string>;

/// A tagged node.
struct OsmPoint {
  std::int64_t id = 0;
  Tags tags;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

/// A tagged way.
struct OsmLine {
  std::int64_t id = 0;
  Tags tags;
  std::vector<Eigen::Vector2d> points;
  std::vector<std::int64_t> nodes;  ///< ids of the nodes, one per point
  int missing = 0;                  ///< number of nodes that are not in the file
  bool edge_of_area = false;        ///< a member of a multipolygon
};

/// A closed way or a multipolygon.
struct OsmArea {
  std::string name;  ///< "way 12", "relation 3"
  Tags tags;
  Area area;
};

/// All tagged objects of an extract.
struct OsmFile {
  world::Rectangle bounds;  ///< as stated in the file, else the bounding box of its nodes
  bool has_bounds = false;  ///< whether the file states them
  std::vector<OsmPoint> points;
  std::vector<OsmLine> lines;
  std::vector<OsmArea> areas;
  std::vector<Skipped> skipped;
};

/// Reads all tagged objects of an OSM XML file by libosmium. x is east and y north of the origin
/// (default: the center of the bounds), projected by the ellipsoid's radii of curvature there; the
/// error is below a meter over 3 km. Rings that cross themselves are repaired(); ways
/// whose ends are within 0.1 m of each other are closed; multipolygons that do not close and
/// incomplete objects are listed in `skipped`. Objects that JOSM marks as deleted are omitted; a
/// multipolygon without tags has those of its outer ways. Throws InputError if the file is no OSM
/// XML, spans more than 5 km or has more than 2 million nodes, and EnvironmentError.
OsmFile read_osm_file(const std::filesystem::path& file, const std::optional<GeoPoint>& origin);

}  // namespace throng::imports
