#include "world/imposed_capacity.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/error.h"

namespace throng::world {

namespace {

constexpr std::array kCodes = {
    CapacityRule{
        "sfpe", 1.32, 0.15, 0,
        "Gwynne and Rosenbaum, SFPE Handbook of Fire Protection Engineering: greatest flow "
        "through doors, of the width less 0.15 m at each side"},
    CapacityRule{"imo", 1.3, 0, 0,
                 "IMO MSC.1/Circ.1533, table of maximum specific flows: doorways"},
    CapacityRule{"rimea", 1.225, 0, 0,
                 "greatest flow of the diagram of Weidmann (1993), to which RiMEA's guideline "
                 "refers"}};

constexpr double kMinuteS = 60;
constexpr std::array kDevices = {
    CapacityRule{"revolving_door", 0, 0, 30 / kMinuteS,
                 "Fruin (1971), Pedestrian Planning and Design: 25 to 35 people per minute and "
                 "direction"},
    CapacityRule{"turnstile", 0, 0, 50 / kMinuteS,
                 "TCRP Report 100 (2003), part 7: 40 to 60 per minute, admission free"},
    CapacityRule{"full_height_turnstile", 0, 0, 20 / kMinuteS,
                 "TCRP Report 100 (2003), part 7: 20 per minute"},
    CapacityRule{
        "ticket_gate", 0, 0, 25 / kMinuteS,
        "RSSB, Automatic Ticket Gates at Stations: 25 per minute, a mean of good practice"}};

const CapacityRule& rule_named(std::span<const CapacityRule> rules, const std::string& name) {
  const auto rule = std::find_if(rules.begin(), rules.end(),
                                 [&](const CapacityRule& one) { return one.name == name; });
  check(rule != rules.end(), "a capacity has the name of a code or of a device");
  return *rule;
}

}  // namespace

std::span<const CapacityRule> capacity_codes() { return kCodes; }
std::span<const CapacityRule> capacity_devices() { return kDevices; }

double ImposedCapacity::per_s_at(double width_m) const {
  if (per_s) return *per_s;
  if (per_ms) return *per_ms * width_m;
  if (!device.empty()) return devices * rule_named(kDevices, device).device_per_s;
  const CapacityRule& rule = rule_named(kCodes, code);
  // Buildings may leave less of a door than its file says: it is narrow then, not closed.
  constexpr double kMinPerS = 0.01;
  return std::max(kMinPerS, rule.per_ms * (width_m - 2 * rule.boundary_m));
}

std::string ImposedCapacity::text() const {
  if (per_s) return fmt::format("{:g} /s", *per_s);
  if (per_ms) return fmt::format("{:g} /(m s)", *per_ms);
  if (!device.empty()) return fmt::format("{} x {}", devices, device);
  return code;
}

}  // namespace throng::world
