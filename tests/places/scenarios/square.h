// A square between six buildings with a door in the east and one in the west, as a blueprint.
#pragma once

#include <nlohmann/json.hpp>

namespace throng::testing {

inline nlohmann::json square() {
  return nlohmann::json::parse(R"({
    "name": "Square",
    "ground": {"min": [-60, -60], "max": [60, 60], "material": "pavers"},
    "inside": {"min": [-30, -30], "max": [30, 30]},
    "exits": [{"id": "east", "from": [20, -2], "to": [20, 2]},
              {"id": "west", "from": [-20, 1.5], "to": [-20, -1.5]}],
    "buildings": [
      {"id": "north", "footprint": [[-24, 20], [24, 20], [24, 24], [-24, 24]], "height_m": 8},
      {"id": "south", "footprint": [[-24, -24], [24, -24], [24, -20], [-24, -20]], "height_m": 8},
      {"id": "ne", "footprint": [[20, 2], [24, 2], [24, 20], [20, 20]], "height_m": 8},
      {"id": "se", "footprint": [[20, -20], [24, -20], [24, -2], [20, -2]], "height_m": 8},
      {"id": "nw", "footprint": [[-24, 1.5], [-20, 1.5], [-20, 20], [-24, 20]], "height_m": 8},
      {"id": "sw", "footprint": [[-24, -20], [-20, -20], [-20, -1.5], [-24, -1.5]], "height_m": 8}],
    "props": [{"kind": "fountain", "position": [0, 0]}],
    "drones": [{"id": "d1", "start": [0, 0, 25]}],
    "people": {
      "groups": [{"doing": "stroll", "area": [[-18, -18], [18, -18], [18, 18], [-18, 18]],
                  "count": 150}],
      "lines": [{"from": [10, 15], "to": [10, 10], "count": 6}],
      "sources": [{"doing": "cross", "exit": "east", "per_minute": 30, "until_s": 60}]}
  })");
}

}  // namespace throng::testing
