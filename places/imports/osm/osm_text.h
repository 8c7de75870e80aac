// Preprocesses the text of an OpenStreetMap extract: removes content that is irrelevant to
// scenarios but may stop libosmium.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace throng::imports {

/// The type ('n', 'w' or 'r') and id of a node, way or relation.
using OsmId = std::pair<char, std::int64_t>;

/// The processed text, and the objects to be ignored.
struct OsmText {
  std::string text;
  std::set<OsmId> deleted;  ///< objects marked as deleted by JOSM; libosmium ignores the mark
};

/// Removes metadata of edits (user, time, changeset) and invalid coordinates from nodes, ways and
/// relations.
OsmText plain_osm(std::string_view text);

}  // namespace throng::imports
