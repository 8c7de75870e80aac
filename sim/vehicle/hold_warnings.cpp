#include "sim/vehicle/hold_warnings.h"

#include <fmt/core.h>

namespace throng::sim {

namespace {

/// Empty for events that say nothing against a drone's mission.
struct Describe {
  std::string operator()(const world::TiltSaturated& event) const {
    return fmt::format("a drone at its max tilt for 3 s, {:.1f} m off its set-point", event.off_m);
  }
  std::string operator()(const world::BlownAway& event) const {
    return fmt::format("a drone blown {:.1f} m off its set-point", event.off_m);
  }
  std::string operator()(const world::BatteryLow&) const {
    return "a drone that landed, its battery being low";
  }
  std::string operator()(const world::BatteryFlat& event) const {
    return fmt::format("a drone that fell from {:.1f} m, its battery being flat", event.height_m);
  }
  std::string operator()(const world::PropellerBroken& event) const {
    return fmt::format("a drone that lost a propeller, hitting something at {:.1f} m/s",
                       event.speed_mps);
  }
  std::string operator()(const world::StructureBroken& event) const {
    return fmt::format("a drone that broke, hitting something at {:.1f} m/s", event.speed_mps);
  }
  std::string operator()(const world::Falling& event) const {
    return fmt::format("a drone that fell from {:.1f} m with {} people near", event.height_m,
                       event.people_near);
  }
  std::string operator()(const world::Collision& event) const {
    return fmt::format("a drone that hit a {} at {:.1f} m/s", world::to_string(event.partner),
                       event.speed_mps);
  }
  std::string operator()(const auto&) const { return ""; }
};

}  // namespace

void HoldWarnings::record(const world::TraceEvent& event) {
  const std::string found = std::visit(Describe{}, event.kind);
  if (found.empty()) return;
  const std::int32_t drone = world::drone_of_event(event.kind).value_or(-1);
  if (!noted_.insert({drone, event.kind.index()}).second) return;
  warnings_.push_back(
      {"", fmt::format("/drones/{}", drone),
       fmt::format("{} ({} after {:.1f} s)", found, world::to_string(event.kind), event.time_s),
       "a flight as it was asked for"});
}

}  // namespace throng::sim
