#include "world/scenarios/blueprint/people.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/geometry/polygon.h"
#include "world/disaster_fields.h"
#include "world/json_reader.h"
#include "world/scenarios/blueprint/closing_doors.h"

namespace throng::scenarios {

using world::JsonValue;

namespace {

constexpr double kFarM = 100'000;
constexpr int kMaxPeople = 100'000;
constexpr double kMaxDurationS = 86'400;
constexpr double kGasHurtsAfterS = 60;  // an assumption: real gases take a breath or many minutes
constexpr SampledLimits kFreeSpeedMps = {0.1, 3, 0.19};  // Weidmann 1993: 0.26 of 1.34
constexpr SampledLimits kEvacuationSpeedMps = {0.1, 3, 0.125};
constexpr SampledLimits kPreMovementS = {0, 3600, 0};
constexpr std::array<std::string_view, 4> kDoings = {"stroll", "wait", "cross", "leave"};

Doing read_doing(const JsonValue& value) {
  const std::string word = value.text();
  const auto* const found = std::find(kDoings.begin(), kDoings.end(), word);
  if (found != kDoings.end()) return static_cast<Doing>(found - kDoings.begin());
  value.reject(fmt::format("one of: {}", fmt::join(kDoings, ", ")));
  return Doing::stroll;
}

std::vector<Eigen::Vector2d> read_outline(const JsonValue& value) {
  std::vector<Eigen::Vector2d> outline;
  for (const JsonValue& corner : value.items(3)) outline.push_back(corner.vector2(kFarM));
  if (outline.size() >= 3 && !geometry::is_simple(outline)) {
    value.reject("edges that touch each other", "a polygon whose edges do not cross");
  }
  return outline;
}

std::optional<std::size_t> read_exit(const JsonValue& value,
                                     const std::vector<world::Exit>& exits) {
  if (!value.exists()) return std::nullopt;
  const std::string id = value.text();
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (exits[i].id == id) return i;
    ids.push_back(exits[i].id);
  }
  value.reject(fmt::format("the id of an exit: {}", fmt::join(ids, ", ")));
  return std::nullopt;
}

/// "random", {"towards": [x, y]} or {"direction_deg": a}; the latter two with "spread_deg".
Facing read_facing(const JsonValue& value) {
  Facing facing;
  const bool is_word = !value["towards"].exists() && !value["direction_deg"].exists();
  if (is_word) {
    if (value.text() != "random") {
      value.reject("\"random\", or an object with \"towards\" or \"direction_deg\"");
    }
    return facing;
  }
  value.fields({}, {"towards", "direction_deg", "spread_deg"});
  if (value["towards"].exists() && value["direction_deg"].exists()) {
    value.reject("both \"towards\" and \"direction_deg\"", "one of them");
  } else if (value["towards"].exists()) {
    facing.kind = Facing::Kind::towards;
    facing.point = value["towards"].vector2(kFarM);
  } else {
    facing.kind = Facing::Kind::direction;
    facing.angle_deg = value["direction_deg"].number(-360, 360);
  }
  if (value["spread_deg"].exists()) facing.spread_deg = value["spread_deg"].number(0, 180);
  return facing;
}

/// The free speed of a group, line or source, if it has one of its own.
std::optional<SampledValue> read_own_speed(const JsonValue& item) {
  const JsonValue value = item["speed_mps"];
  if (!value.exists()) return std::nullopt;
  return read_sampled(value, kFreeSpeedMps);
}

Group read_group(const JsonValue& item) {
  item.fields({"doing", "area", "count"}, {"facing", "speed_mps"});
  Group group{read_doing(item["doing"]), read_outline(item["area"]),
              item["count"].integer(1, kMaxPeople)};
  if (item["facing"].exists()) {
    if (group.doing != Doing::wait) item["facing"].reject("a group that is doing \"wait\"");
    group.facing = read_facing(item["facing"]);
  }
  group.speed_mps = read_own_speed(item);
  return group;
}

Line read_line(const JsonValue& item) {
  item.fields({"from", "to", "count"}, {"facing", "speed_mps"});
  Line line{item["from"].vector2(kFarM), item["to"].vector2(kFarM), item["count"].integer(1, 1000)};
  if (item["facing"].exists()) line.facing = read_facing(item["facing"]);
  line.speed_mps = read_own_speed(item);
  return line;
}

Source read_source(const JsonValue& item, const std::vector<world::Exit>& exits) {
  item.fields({"doing"},
              {"exit", "from", "to", "per_minute", "until_s", "table", "towards", "speed_mps"});
  Source source;
  source.speed_mps = read_own_speed(item);
  source.doing = read_doing(item["doing"]);
  source.exit = read_exit(item["exit"], exits);
  source.towards = read_exit(item["towards"], exits);
  if (source.towards && !is_destination(exits[*source.towards], exits)) {
    source.towards.reset();
    source.doing = Doing::cross;  // to any other exit
  }
  if (!item["exit"].exists()) {
    if (!item["from"].exists() || !item["to"].exists()) {
      item.reject("no position", "\"exit\", or \"from\" and \"to\"");
    }
    source.from = item["from"].vector2(kFarM);
    source.to = item["to"].vector2(kFarM);
  }
  if (item["until_s"].exists()) source.until_s = item["until_s"].number(1, kMaxDurationS);
  for (const JsonValue& row : item["table"].items()) {
    const auto pair = row.tuple(2, "[seconds, people]");
    if (pair.empty()) continue;
    source.table.emplace_back(pair[0].number(0, kMaxDurationS), pair[1].integer(1, kMaxPeople));
  }
  if (item["table"].exists() == item["per_minute"].exists()) {
    item.reject(
        fmt::format("{} of \"per_minute\" and \"table\"", item["table"].exists() ? "both" : "none"),
        "one of them");
  } else if (item["per_minute"].exists()) {
    source.per_minute = item["per_minute"].number(0.01, 10'000);
  }
  return source;
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

/// Reads the fields that a disaster of a scenario has, too.
world::Disaster read_disaster(const JsonValue& item, int agent) {
  world::Disaster disaster = world::begin_disaster();
  disaster.agent = agent;
  if (!item.value().is_object()) return disaster;
  nlohmann::json shared = nlohmann::json::object();
  for (const auto& field : world::disaster_fields().fields()) {
    for (const std::string& name : {field.path, field.deprecated_name}) {
      if (item.value().contains(name)) shared[name] = item.value()[name];
    }
  }
  world::disaster_fields().read_checked(shared, disaster, item.location());
  return disaster;
}

Danger read_danger(const JsonValue& item, int agent) {
  item.fields({},
              {"kind", "position", "start_s", "radius_m", "growth_mps", "max_radius_m", "noticed_m",
               "notice_growth_mps", "blocked_m", "hurts_m", "hurts_after_s", "panic"},
              {"most_m"});
  Danger danger = usual_danger(read_disaster(item, agent));
  const auto read = [&](std::string_view key, double& value) {
    if (item[key].exists()) value = item[key].number(0, 10'000);
  };
  read("noticed_m", danger.noticed_m);
  read("notice_growth_mps", danger.notice_growth_mps);
  read("blocked_m", danger.blocked_m);
  read("hurts_m", danger.hurts_m);
  read("hurts_after_s", danger.hurts_after_s);
  const bool can_take_time =
      danger.seen.kind == world::DisasterKind::fire || danger.seen.kind == world::DisasterKind::gas;
  if (!can_take_time && danger.hurts_after_s > 0) {
    item["hurts_after_s"].reject("0, or a fire or gas: other disasters hurt at once");
  }
  if (item["panic"].exists()) danger.panic = item["panic"].boolean();
  return danger;
}

void read_speeds_and_times(const JsonValue& value, People& people) {
  if (value["speed_mps"].exists()) {
    people.speed_mps = read_sampled(value["speed_mps"], kFreeSpeedMps);
  }
  if (value["pre_movement_s"].exists()) {
    people.pre_movement_s = read_sampled(value["pre_movement_s"], kPreMovementS);
  }
  const JsonValue evacuation = value["evacuation_speed_mps"];
  if (!evacuation.exists()) return;
  if (!evacuation.is_text()) {
    people.evacuation_speed_mps = read_sampled(evacuation, kEvacuationSpeedMps);
  } else if (evacuation.text() == "unchanged") {
    people.evacuation_speed_mps.reset();
  } else {
    evacuation.reject("\"unchanged\", a number or a distribution");
  }
}

}  // namespace

bool anybody_leaves(const People& people) {
  const auto leaves = [](const auto& who) {
    return who.doing == Doing::cross || who.doing == Doing::leave;
  };
  return std::any_of(people.groups.begin(), people.groups.end(), leaves) ||
         std::any_of(people.sources.begin(), people.sources.end(), [&](const Source& source) {
           return source.towards.has_value() || leaves(source);
         });
}

People read_people(const JsonValue& value, const JsonValue& disasters,
                   const std::vector<world::Exit>& exits) {
  People people;
  value.fields({}, {"groups", "lines", "sources", "spots", "speed_mps", "in_groups",
                    "pre_movement_s", "evacuation_speed_mps"});
  for (const JsonValue& item : value["groups"].items()) people.groups.push_back(read_group(item));
  for (const JsonValue& item : value["lines"].items()) people.lines.push_back(read_line(item));
  for (const JsonValue& item : value["sources"].items()) {
    people.sources.push_back(read_source(item, exits));
  }
  for (const JsonValue& spot : value["spots"].items()) {
    people.spots.push_back(spot.vector2(kFarM));
  }
  read_speeds_and_times(value, people);
  if (value["in_groups"].exists()) people.in_groups = value["in_groups"].number(0, 1);
  for (const JsonValue& item : disasters.items()) {
    people.dangers.push_back(read_danger(item, static_cast<int>(people.dangers.size())));
  }
  if (people.groups.empty() && people.lines.empty() && people.sources.empty()) {
    value.reject("nobody", "\"groups\", \"lines\" or \"sources\"");
  }
  return people;
}

}  // namespace throng::scenarios
