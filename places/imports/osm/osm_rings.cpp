#include "places/imports/osm/osm_rings.h"

#include <algorithm>

namespace throng::imports {

namespace {

bool is_closed(const WayNodes& way) {
  return way.nodes.size() >= 4 && way.nodes.front() == way.nodes.back();
}

void turn(WayNodes& way) {
  std::reverse(way.nodes.begin(), way.nodes.end());
  std::reverse(way.points.begin(), way.points.end());
}

// Puts a way that begins where the chain ends behind it.
bool append(WayNodes& chain, WayNodes& way) {
  if (chain.nodes.back() == way.nodes.back()) turn(way);
  if (chain.nodes.back() != way.nodes.front()) return false;
  chain.nodes.insert(chain.nodes.end(), way.nodes.begin() + 1, way.nodes.end());
  chain.points.insert(chain.points.end(), way.points.begin() + 1, way.points.end());
  return true;
}

}  // namespace

JoinedRings joined_rings(std::vector<WayNodes> ways) {
  std::erase_if(ways, [](const WayNodes& way) { return way.nodes.size() < 2; });
  JoinedRings result;
  while (!ways.empty()) {
    WayNodes chain = std::move(ways.front());
    ways.erase(ways.begin());
    for (bool longer = true; longer && !is_closed(chain);) {
      longer = false;
      for (auto way = ways.begin(); way != ways.end(); ++way) {
        if (is_closed(*way) || !append(chain, *way)) continue;
        ways.erase(way);
        longer = true;
        break;
      }
    }
    if (!is_closed(chain)) {
      ++result.open;
      continue;
    }
    chain.points.pop_back();
    result.rings.push_back(std::move(chain.points));
  }
  return result;
}

}  // namespace throng::imports
