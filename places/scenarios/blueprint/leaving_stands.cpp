#include "places/scenarios/blueprint/leaving_stands.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "places/scenarios/blueprint/standing.h"
#include "world/stand_departures.h"

namespace throng::scenarios {

namespace {

constexpr double kFootClearanceM = 0.45;

bool leaves(const world::Stand& stand) {
  return stand.spectators.count > 0 && std::isfinite(stand.spectators.leave_at_s);
}

}  // namespace

bool anybody_leaves_stands(const world::Scenario& scenario) {
  return std::any_of(scenario.stands.begin(), scenario.stands.end(), leaves);
}

void add_leaving_spectators(const world::Scenario& scenario, const fields::FieldLocation& place,
                            People& people) {
  if (!anybody_leaves_stands(scenario)) return;
  const Solids solids(scenario);
  for (std::size_t i = 0; i < scenario.stands.size(); ++i) {
    const world::Stand& stand = scenario.stands[i];
    if (!leaves(stand)) continue;
    const std::vector<world::Aisle> aisles = world::aisles(stand);
    const auto blocked = std::find_if(aisles.begin(), aisles.end(), [&](const auto& aisle) {
      const Eigen::Vector2d foot = world::aisle_foot(stand, aisle);
      return !scenario.inside.contains(foot) || !solids.is_clear(foot, kFootClearanceM);
    });
    if (blocked != aisles.end()) {
      const Eigen::Vector2d foot = world::aisle_foot(stand, *blocked);
      place.below("stands").below(i).reject(
          fmt::format("an aisle that ends at ({:.2f}, {:.2f})", foot.x(), foot.y()),
          "aisles that end on free ground of \"inside\" where spectators leave");
      continue;
    }
    const std::vector<world::Departure> all = world::departures(stand);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (k == 0 || all[k].aisle != all[k - 1].aisle) {
        Source& source = people.sources.emplace_back();
        source.doing = Doing::leave;
        source.from = source.to = world::aisle_foot(stand, aisles[all[k].aisle]);
        source.of_stand = i;
      }
      people.sources.back().table.emplace_back(all[k].at_foot_s, 1);
    }
  }
}

}  // namespace throng::scenarios
