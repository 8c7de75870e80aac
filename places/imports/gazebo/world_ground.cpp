#include "places/imports/gazebo/world_ground.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "places/imports/parts/populate.h"

namespace throng::imports {

using Eigen::Vector2d;

void lay_ground(const std::string& file, world::Rectangle reached, std::vector<FlatArea> flat,
                ImportedScenario& place) {
  constexpr double kMaxSizeM = 3'000;
  constexpr double kMinGroundM = 8;
  constexpr double kAroundM = 8;
  constexpr double kMinFreeShare = 0.3;
  const Vector2d size = reached.max - reached.min;
  if (!(size.maxCoeff() <= kMaxSizeM)) {
    throw InputError({file, "", fmt::format("{:.0f} m x {:.0f} m", size.x(), size.y()),
                      "at most 3 km, in meters"});
  }
  bool crowded = size.minCoeff() < kMinGroundM;
  place.inside = reached;
  if (!crowded && open_ground_m2(place) < kMinFreeShare * size.prod()) {
    place.skipped.push_back(
        {file, 0, "edge", "most of the ground is walled up or built on: 8 m more around it"});
    crowded = true;
  }
  if (crowded) {
    reached.min -= Vector2d::Constant(kAroundM);
    reached.max += Vector2d::Constant(kAroundM);
  }
  place.inside = reached;
  std::stable_sort(flat.begin(), flat.end(),
                   [](const FlatArea& a, const FlatArea& b) { return a.z < b.z; });
  for (const FlatArea& area : flat) {
    for (const Area& part : clipped({area.corners, {}}, ground_rectangle(place))) {
      for (Corners& corners : simple_parts(part)) {
        place.areas.push_back({std::move(corners), area.material, false});
      }
    }
  }
}

}  // namespace throng::imports
