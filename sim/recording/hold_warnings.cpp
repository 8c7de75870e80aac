#include "sim/recording/hold_warnings.h"

#include <fmt/core.h>

namespace throng::sim {

namespace {

std::string found_in(const world::TraceEvent& event) {
  if (event.type == "tilt_saturated") {
    return fmt::format("a drone at its greatest tilt for 3 s, {:.1f} m off its place", event.value);
  }
  if (event.type == "blown_away") {
    return fmt::format("a drone blown {:.1f} m off its place", event.value);
  }
  if (event.type == "battery_low") return "a drone that landed, its battery being low";
  if (event.type == "battery_flat") {
    return fmt::format("a drone that fell from {:.1f} m, its battery being flat", event.value);
  }
  if (event.type == "propeller_broken") {
    return fmt::format("a drone that lost a propeller, hitting something at {:.1f} m/s",
                       event.value);
  }
  if (event.type == "structure_broken") {
    return fmt::format("a drone that broke, hitting something at {:.1f} m/s", event.value);
  }
  if (event.type == "falling") {
    return fmt::format("a drone that fell from {:.1f} m with {:g} people near", event.value,
                       event.extra);
  }
  return fmt::format("a drone that hit a {} at {:.1f} m/s", event.partner, event.value);
}

}  // namespace

void HoldWarnings::note(const world::TraceEvent& event) {
  static const std::set<std::string> kinds{"tilt_saturated",   "blown_away", "battery_low",
                                           "battery_flat",     "collision",  "propeller_broken",
                                           "structure_broken", "falling"};
  if (kinds.count(event.type) == 0 || !noted_.insert({event.drone, event.type}).second) return;
  warnings_.push_back(
      {"", fmt::format("/drones/{}", event.drone),
       fmt::format("{} ({} after {:.1f} s)", found_in(event), event.type, event.time_s),
       "a flight as it was asked for"});
}

}  // namespace throng::sim
