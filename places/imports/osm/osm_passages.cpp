#include "places/imports/osm/osm_passages.h"

#include <fmt/core.h>

#include <algorithm>

#include "places/imports/osm/osm_lengths.h"
#include "places/imports/osm/osm_tags.h"

namespace throng::imports {

using Eigen::Vector2d;

namespace {

std::vector<Vector2d> lengthened(std::vector<Vector2d> line) {
  const auto beyond = [](const Vector2d& end, const Vector2d& before) {
    constexpr double kBeyondM = 0.5;
    const Vector2d along = end - before;
    return along.norm() < 1e-6 ? end : Vector2d(end + kBeyondM * along.normalized());
  };
  const Vector2d first = beyond(line[0], line[1]);
  line.back() = beyond(line.back(), line[line.size() - 2]);
  line.front() = first;
  return line;
}

double clear_height_m(const Tags& tags) {
  constexpr double kUsualM = 3;
  constexpr double kLowestM = 2.2;
  constexpr double kHighestM = 50;
  for (const char* key : {"maxheight", "height"}) {
    const auto height = length_in(tag_value(tags, key));
    if (height && *height > 0) return std::clamp(*height, kLowestM, kHighestM);
  }
  return kUsualM;
}

}  // namespace

bool is_passage(const Tags& tags) {
  const std::string& covered = tag_value(tags, "covered");
  return tag_value(tags, "tunnel") == "building_passage" || covered == "yes" ||
         covered == "arcade" || covered == "colonnade" || covered == "building_passage";
}

std::vector<Passage> find_passages(const std::vector<OsmLine>& lines) {
  constexpr double kNarrowestM = 2;  // people keep away from its walls
  std::vector<Passage> passages;
  for (const OsmLine& line : lines) {
    const auto kind = way_kind(line.tags);
    if (!kind || !is_passage(line.tags)) continue;
    passages.push_back({fmt::format("way {}", line.id),
                        along(lengthened(line.points), std::max(kind->width_m, kNarrowestM)),
                        clear_height_m(line.tags)});
  }
  return passages;
}

}  // namespace throng::imports
