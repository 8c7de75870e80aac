// The parts of scenarios::check() that concern a run's figures: who counts, and when.
#include <fmt/core.h>

#include <algorithm>

#include "base/geometry/polygon.h"
#include "places/scenarios/check/check_scenario.h"
#include "places/scenarios/check/sufferers.h"

namespace throng::scenarios {

using world::Exit;
using world::Scenario;

void check_drawn_ground(const Scenario& scenario, Findings& findings) {
  if (scenario.ground.contains(scenario.inside.bounds.min) &&
      scenario.ground.contains(scenario.inside.bounds.max)) {
    return;
  }
  findings.warning(
      "/ground",
      fmt::format("ground from {} to {}, smaller than \"inside\", from {} to {}",
                  point_text(scenario.ground.min), point_text(scenario.ground.max),
                  point_text(scenario.inside.bounds.min), point_text(scenario.inside.bounds.max)),
      "ground wherever people walk who have not escaped",
      "enlarge \"ground\": images show nothing under people beyond it; or \"inside\" is too large");
}

void check_outsiders(const Scenario& scenario, const LoadedCrowd& loaded, Findings& findings) {
  Sufferers outside(loaded);
  std::size_t people = 0;
  for (std::size_t agent = 0; agent < loaded.count(); ++agent) {
    if (!is_to_arrive_or_there(loaded, agent)) continue;
    ++people;
    if (scenario.inside.contains(loaded.start(agent))) continue;
    outside.add(agent, loaded.start(agent), "outside of \"inside\"");
  }
  if (!outside.any()) return;
  findings.warning("/inside",
                   fmt::format("{}, out of {} people: no figure counts them until they are inside",
                               outside.text(), people),
                   "people who start and arrive inside",
                   "start them inside, or enlarge \"inside\"");
}

void check_outline(const Scenario& scenario, const OutlineSurvey& survey, Findings& findings) {
  const std::string expected = "walls with no way out but the exits, which count people";
  const char* const where = findings.either("/buildings", "/crowd/scene");
  if (survey.is_open) {
    findings.warning(where,
                     fmt::format("a scenario that walls do not close: people leave it without "
                                 "passing an exit, for example at {}",
                                 point_text(survey.open_at)),
                     expected,
                     findings.either("put buildings between the exits, or more exits",
                                     "put obstacles between the exits, or more exits"));
  }
  for (const Gap& gap : survey.gaps) {
    const auto distance_m = [&](const Exit& exit) {
      return geometry::distance_to_segment(exit.from, exit.to, gap.middle);
    };
    const Exit& nearest = *std::min_element(
        scenario.exits.begin(), scenario.exits.end(),
        [&](const Exit& a, const Exit& b) { return distance_m(a) < distance_m(b); });
    constexpr double kInDoorM = 1.5;  // a wall may be so thick
    const bool is_door = !nearest.open && distance_m(nearest) < kInDoorM;
    findings.warning(
        where,
        fmt::format("a gap {:.1f} m wide at {}, {} exit \"{}\"{}, by which people leave without "
                    "passing an open exit",
                    gap.width_m, point_text(gap.middle), is_door ? "in" : "nearest to", nearest.id,
                    is_door ? ", which is closed but has no obstacle" : ""),
        expected,
        findings.either(
            "close it with a building, which may be as thin as a wall, or make an exit of it",
            "close it with an <Obstacle>, or make an exit of it"));
  }
}

}  // namespace throng::scenarios
