#include "world/fields/capacity_fields.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/json/json_describe.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMinPerS = 0.01;
constexpr double kMaxPerS = 1000;
constexpr double kMaxPerMs = 10;
constexpr int kMaxDevices = 1000;

fields::Values rule_names(std::span<const CapacityRule> rules) {
  std::vector<std::string> names;
  for (const CapacityRule& rule : rules) names.emplace_back(rule.name);
  return fields::one_of_words(names);
}

std::string help_for(const std::string& what, std::span<const CapacityRule> rules) {
  std::string help = what;
  for (const CapacityRule& rule : rules) {
    help += &rule == rules.data() ? ": " : "; ";
    help += rule.device_per_s > 0 ? fmt::format("{} {:.3g}/s", rule.name, rule.device_per_s)
                                  : fmt::format("{} {:g}/(m s)", rule.name, rule.per_ms);
    help += fmt::format(" ({})", rule.source);
  }
  return help + ".";
}

}  // namespace

const FieldTable<ImposedCapacity>& capacity_fields() {
  static const FieldTable<ImposedCapacity> fields = [] {
    FieldTable<ImposedCapacity> table;
    table
        .add("per_s", "", "1/s", fields::numbers(kMinPerS, kMaxPerS), at(&ImposedCapacity::per_s),
             "People per second.")
        .without_default();
    table
        .add("per_ms", "", "1/(m s)", fields::numbers(kMinPerS, kMaxPerMs),
             at(&ImposedCapacity::per_ms), "People per second and meter of the width.")
        .without_default();
    table
        .add("code", "", "", rule_names(capacity_codes()), at(&ImposedCapacity::code),
             help_for("A building code", capacity_codes()))
        .without_default();
    table
        .add("device", "", "", rule_names(capacity_devices()), at(&ImposedCapacity::device),
             help_for("Devices that let people pass one by one", capacity_devices()))
        .without_default();
    table.add("devices", "", "", fields::integers(1, kMaxDevices), at(&ImposedCapacity::devices),
              "Number of devices side by side.");
    return table;
  }();
  return fields;
}

void check_capacity(const ImposedCapacity& capacity, double width_m, const json& value,
                    const FieldLocation& place) {
  std::vector<std::string> given;
  for (const char* field : {"per_s", "per_ms", "code", "device"}) {
    if (value.contains(field)) given.emplace_back(field);
  }
  if (given.size() != 1) {
    place.reject(
        given.empty() ? describe(value) : fmt::format("\"{}\" and \"{}\"", given[0], given[1]),
        "one of \"per_s\", \"per_ms\", \"code\" and \"device\"");
  } else if (value.contains("devices") && given[0] != "device") {
    place.below("devices").reject(describe(value["devices"]), "none without \"device\"");
  } else if (!place.has_problem() && given[0] == "code" && capacity.per_s_at(width_m) <= kMinPerS) {
    place.below("code").reject(
        fmt::format("a door of {:g} m, of which this code counts nothing", width_m),
        "a wider door, or another capacity");
  }
}

}  // namespace throng::world
