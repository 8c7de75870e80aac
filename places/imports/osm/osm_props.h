// The props of a map: trees, lamps and other furniture of streets.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "places/imports/osm/osm_file.h"
#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// Adds props to a scenario, and lists nodes that are none by their kind.
class MapProps {
 public:
  MapProps(ImportedScenario& place, std::string source)
      : place_(place), source_(std::move(source)) {}

  /// Adds the prop of a node, if it is one.
  void add(const OsmPoint& point);
  /// Adds the trees of a row, 8 m apart.
  void add_row(const OsmLine& line);
  /// Lists nodes of other kinds and props that were left out: a line for each kind.
  void list();

 private:
  void add(world::PropKind kind, const Eigen::Vector2d& at, const Tags& tags, std::uint32_t look,
           const std::string& name);
  void note_other(const OsmPoint& point);

  ImportedScenario& place_;
  std::string source_;
  std::map<std::string, std::vector<std::int64_t>> others_;  ///< by "amenity=cafe"
  std::size_t outside_ = 0;
  std::size_t too_many_ = 0;
};

}  // namespace throng::imports
