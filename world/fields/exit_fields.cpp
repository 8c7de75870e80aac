#include "world/fields/exit_fields.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/json/json_describe.h"
#include "world/exits/exit_overlap.h"
#include "world/fields/capacity_fields.h"
#include "world/fields/document_values.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kNarrowestExitM = 0.1;
constexpr double kMaxClosingS = 1e6;

}  // namespace

const FieldTable<Exit>& exit_fields() {
  static const FieldTable<Exit> fields = [] {
    FieldTable<Exit> table;
    add_id(table);
    table.add("from", "", "m", points(), at(&Exit::from), "One end of the door.").required();
    table.add("to", "", "m", points(), at(&Exit::to), "The other end of the door.").required();
    table.add_read(
        "goals", fields::open_lists(1, goals().rules),
        [](Exit& exit, const json& value, const FieldLocation& /*place*/) {
          for (const json& goal : value) exit.goals.push_back(goal_named(goal));
        },
        "Goals of the behavior file, [goal set, goal], each of one exit only: people who head for "
        "one intend this exit. Recorded people need none.");
    table
        .add("outward", "", "m", points(), at(&Exit::outward),
             "Vector that points out of the door, at right angles to it; default: away from the "
             "middle of inside.")
        .without_default();
    table.add("open", "", "", fields::booleans(), at(&Exit::open),
              "False closes the door for the whole run: drones lead nobody there; the crowd's "
              "files must have an obstacle in it.");
    table
        .add("closes_at_s", "", "s", fields::numbers(0, kMaxClosingS), at(&Exit::closes_at_s),
             "Time from which an open door is closed, because a hazard reaches it; the crowd's "
             "files must say so too.")
        .without_default()
        .renamed_from("shuts_s");
    table
        .add_object("capacity", capacity_fields(), at(&Exit::capacity),
                    "Capacity that people who go out are held to, whatever the pedestrian model "
                    "does; default: none.")
        .without_default();
    return table;
  }();
  return fields;
}

namespace {

/// Makes the outward vector the unit normal of the segment that points out.
void check_outward(Exit& exit, const json& value, const geometry::Region& inside,
                   const FieldLocation& place) {
  const Eigen::Vector2d along = exit.to - exit.from;
  const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
  if (has_valid(value, "outward", place)) {
    const Eigen::Vector2d given = exit.outward;
    constexpr double kCosineOfADegree = 0.99985;
    if (std::abs(given.normalized().dot(normal)) < kCosineOfADegree) {
      place.below("outward").reject(
          describe(value["outward"]),
          "a direction at right angles to the segment from \"from\" to \"to\"");
    }
    exit.outward = given.dot(normal) >= 0 ? normal : -normal;
    return;
  }
  constexpr double kBesideM = 0.1;
  const bool is_in_front = inside.contains(exit.middle() - kBesideM * normal);
  const bool is_in_behind = inside.contains(exit.middle() + kBesideM * normal);
  if (!inside.outline.empty() && is_in_front != is_in_behind) {
    exit.outward = is_in_front ? normal : -normal;
  } else {
    exit.outward = normal.dot(exit.middle() - inside.bounds.center()) >= 0 ? normal : -normal;
  }
}

void check_exit(Exit& exit, const json& value, const geometry::Region& inside,
                const FieldLocation& place) {
  if (check_ends(exit.from, exit.to, kNarrowestExitM, value, place)) {
    check_outward(exit, value, inside, place);
  } else {
    exit.to = exit.from;  // nothing is in its way
  }
  if (exit.capacity && has_valid(value, "capacity", place)) {
    check_capacity(*exit.capacity, exit.length_m(), value["capacity"], place.below("capacity"));
  }
  if (!exit.open && std::isfinite(exit.closes_at_s)) {
    const char* field = value.contains("closes_at_s") ? "closes_at_s" : "shuts_s";
    place.below(field).reject("a time, though the door is never open", "none");
  }
}

}  // namespace

const FieldTable<InnerDoor>& inner_door_fields() {
  static const FieldTable<InnerDoor> fields = [] {
    FieldTable<InnerDoor> table;
    add_id(table);
    table.add("from", "", "m", points(), at(&InnerDoor::from), "One end of the door.").required();
    table.add("to", "", "m", points(), at(&InnerDoor::to), "The other end of the door.").required();
    table
        .add_read(
            "capacity", fields::object_with(capacity_fields().schema()),
            [](InnerDoor& door, const json& value, const FieldLocation& place) {
              capacity_fields().read_checked(value, door.capacity, place);
            },
            "Capacity of both directions together.")
        .required();
    return table;
  }();
  return fields;
}

namespace {

/// Rejects goals that an exit before has.
void check_goals(const std::vector<Exit>& exits, const FieldLocation& place) {
  std::set<std::pair<int, int>> claimed;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    const std::vector<GoalRef>& goals = exits[i].goals;
    for (std::size_t j = 0; j < goals.size(); ++j) {
      if (claimed.insert({goals[j].set, goals[j].goal}).second) continue;
      place.below(i).below("goals").below(j).reject(
          fmt::format("[{}, {}]", goals[j].set, goals[j].goal), "a goal of this exit only");
    }
  }
}

/// Rejects doors at which the same people would count.
void check_overlaps(const std::vector<Exit>& exits, const FieldLocation& place) {
  for (const ExitOverlap& overlap : overlapping_exits(exits)) {
    place.below(overlap.second)
        .reject(overlap.found,
                fmt::format("exits that at most touch, none less than {:g} m behind another: "
                            "those who go out there would count at both",
                            kExitDepthM));
  }
}

}  // namespace

void check_exits(Scenario& scenario, const json& list, const FieldLocation& place) {
  std::vector<Exit>& exits = scenario.exits;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    check_exit(exits[i], list[i], scenario.inside, place.below(i));
  }
  check_ids(exits, place);
  check_goals(exits, place);
  if (!place.has_problem()) check_overlaps(exits, place);
}

void check_inner_doors(Scenario& scenario, const json& list, const FieldLocation& place) {
  for (std::size_t i = 0; i < scenario.doors.size(); ++i) {
    const InnerDoor& door = scenario.doors[i];
    const FieldLocation at_door = place.below(i);
    check_ends(door.from, door.to, kNarrowestExitM, list[i], at_door);
    if (!has_valid(list[i], "capacity", at_door)) continue;
    check_capacity(door.capacity, (door.to - door.from).norm(), list[i]["capacity"],
                   at_door.below("capacity"));
  }
  check_ids(scenario.doors, place);
}

}  // namespace throng::world
