// The text of an OpenStreetMap extract, less what is nothing to a scenario and may still stop
// libosmium.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace throng::imports {

/// 'n', 'w' or 'r', and the id.
using OsmId = std::pair<char, std::int64_t>;

struct OsmText {
  std::string text;
  std::set<OsmId> deleted;  ///< by a mapper in JOSM, whose mark libosmium does not know
};

/// Takes who changed what and when out of nodes, ways and relations, and coordinates that are none.
OsmText plain_osm(std::string_view text);

}  // namespace throng::imports
