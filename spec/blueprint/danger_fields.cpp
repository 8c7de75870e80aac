// Fields of the disasters of a blueprint.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/json/json_describe.h"
#include "spec/blueprint/people_fields.h"
#include "world/fields/disaster_fields.h"
#include "world/fields/document_values.h"

namespace throng::scenarios {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMaxEffect = 10'000;   // m, m/s or s
constexpr double kGasHurtsAfterS = 60;  // an assumption: real gases take a breath or many minutes

/// A disaster as the blueprint has it.
struct GivenDanger {
  world::Disaster seen;
  std::optional<double> noticed_m;
  std::optional<double> notice_growth_mps;
  std::optional<double> blocked_m;
  std::optional<double> hurts_m;
  std::optional<double> hurts_after_s;
  std::optional<bool> panic;
};

const FieldTable<GivenDanger>& danger_fields() {
  static const FieldTable<GivenDanger> fields = [] {
    FieldTable<GivenDanger> table;
    const fields::Values effects = fields::numbers(0, kMaxEffect);
    table.add_all("", world::disaster_fields(), at(&GivenDanger::seen));
    table.add("noticed_m", "", "m", effects, at(&GivenDanger::noticed_m),
              "Distance from which people notice it at its start. Default: explosion and collapse "
              "40, fire 15, attacker 10, gas its radius.");
    table.add("notice_growth_mps", "", "m/s", effects, at(&GivenDanger::notice_growth_mps),
              "Speed at which the news spreads. Default: explosion and collapse 10, fire 1.5, "
              "attacker 0.8, gas its growth.");
    table.add("blocked_m", "", "m", effects, at(&GivenDanger::blocked_m),
              "Distance that people who flee keep. It grows with the hazard, in steps of 2 m or "
              "more, for 5 minutes. Default: radius_m; attacker: 0.");
    table.add("hurts_m", "", "m", effects, at(&GivenDanger::hurts_m),
              "Distance within which people become casualties. Default: radius_m of an explosion "
              "or a collapse; attacker: 0.5; fire and gas: 0 (nobody).");
    table.add("hurts_after_s", "", "s", effects, at(&GivenDanger::hurts_after_s),
              "Time that a person must have been within a fire or gas, in all, before it hurts. "
              "Default: gas 60, an assumption without a source; fire 0.");
    table.add("panic", "", "", fields::booleans(), at(&GivenDanger::panic),
              "Whether people who flee panic, and others catch it. Default: true for explosion and "
              "attacker.");
    return table;
  }();
  return fields;
}

/// Defaults of a kind of disaster, for values that the blueprint does not give.
Danger usual_danger(const world::Disaster& seen) {
  switch (seen.kind) {
    case world::DisasterKind::explosion:
      return {seen, 40, 10, seen.radius_m, true, seen.radius_m};
    case world::DisasterKind::collapse:
      return {seen, 40, 10, seen.radius_m, false, seen.radius_m};
    case world::DisasterKind::attacker:
      return {seen, 10, 0.8, 0, true, 0.5};
    case world::DisasterKind::gas:
      return {seen, seen.radius_m,  std::max(seen.growth_mps, 0.1), seen.radius_m, false,
              0,    kGasHurtsAfterS};
    case world::DisasterKind::fire:
      break;
  }
  return {seen, 15, 1.5, seen.radius_m, false, 0};
}

/// The danger that a blueprint's item gives.
Danger complete_danger(const GivenDanger& given, const json& value, const FieldLocation& place) {
  Danger danger = usual_danger(given.seen);
  danger.noticed_m = given.noticed_m.value_or(danger.noticed_m);
  danger.notice_growth_mps = given.notice_growth_mps.value_or(danger.notice_growth_mps);
  danger.blocked_m = given.blocked_m.value_or(danger.blocked_m);
  danger.hurts_m = given.hurts_m.value_or(danger.hurts_m);
  danger.hurts_after_s = given.hurts_after_s.value_or(danger.hurts_after_s);
  danger.panic = given.panic.value_or(danger.panic);
  const bool can_take_time =
      danger.seen.kind == world::DisasterKind::fire || danger.seen.kind == world::DisasterKind::gas;
  if (!can_take_time && danger.hurts_after_s > 0 && world::has_valid(value, "kind", place)) {
    place.below("hurts_after_s")
        .reject(describe(value["hurts_after_s"]),
                "0, or a fire or gas: other disasters hurt at once");
  }
  return danger;
}

}  // namespace

fields::Values danger_lists() {
  return fields::open_lists(0, fields::object_with(danger_fields().schema()).rules);
}

std::vector<Danger> read_dangers(const json& list, const FieldLocation& place) {
  std::vector<Danger> dangers;
  if (!fields::check_value(list, danger_lists(), place)) return dangers;
  const std::vector<GivenDanger> given = danger_fields().read_list(list, place);
  for (std::size_t i = 0; i < given.size(); ++i) {
    dangers.push_back(complete_danger(given[i], list[i], place.below(i)));
    dangers.back().seen.agent = static_cast<int>(i);
  }
  return dangers;
}

}  // namespace throng::scenarios
