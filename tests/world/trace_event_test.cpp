#include "world/trace_event.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "base/error.h"

namespace throng::world {
namespace {

/// One event of each kind, and its row as docs/trace.md has it.
struct Example {
  EventKind kind;
  EventRow row;
};

std::vector<Example> examples() {
  return {
      {AgentEscaped{5, 2}, {3, "agent_escaped", 5, -1, 2}},
      {AgentEscaped{5, -1}, {3, "agent_escaped", 5, -1, -1}},
      {ExitClosed{4}, {3, "exit_shut", -1, -1, 4}},
      {TiltSaturated{1, 6.5}, {3, "tilt_saturated", -1, 1, 6.5}},
      {BlownAway{1, 6.5}, {3, "blown_away", -1, 1, 6.5}},
      {BatteryLow{1, 0.15}, {3, "battery_low", -1, 1, 0.15}},
      {Landed{1, 0.25}, {3, "landed", -1, 1, 0.25}},
      {BatteryFlat{1, 12}, {3, "battery_flat", -1, 1, 12}},
      {Collision{1, Partner::person, 7, 4, 2}, {3, "collision", 7, 1, 4, "person", -1, 2}},
      {Collision{1, Partner::building, 7, 4, 2}, {3, "collision", -1, 1, 4, "building", 7, 2}},
      {Collision{1, Partner::ground, -1, 4, 2}, {3, "collision", -1, 1, 4, "ground", -1, 2}},
      {PropellerBroken{1, 4, 3}, {3, "propeller_broken", -1, 1, 4, "", -1, 3}},
      {StructureBroken{1, 9}, {3, "structure_broken", -1, 1, 9}},
      {Falling{1, 20, 6}, {3, "falling", -1, 1, 20, "", -1, 6}},
      {FallHazard{1, 7, 2.5, 1.5}, {3, "fall_hazard", 7, 1, 2.5, "", -1, 1.5}},
      {NearMiss{1, Partner::drone, 0, 0.5, 0.75}, {3, "near_miss", -1, 1, 0.5, "drone", 0, 0.75}},
      {NearMiss{1, Partner::person, 7, 0.5, {}}, {3, "near_miss", 7, 1, 0.5, "person", -1, -1}},
      {PersonFall{7, true, 30, 0}, {3, "fall", 7, -1, 30, "drone", -1, 0}},
      {PersonFall{7, false, 0, 1600}, {3, "fall", 7, -1, 0, "crowd", -1, 1600}},
      {Downwash{1, 7, 2.5, 6}, {3, "downwash", 7, 1, 2.5, "", -1, 6}}};
}

auto columns(const EventRow& row) {
  return std::tuple(row.time_s, row.type, row.agent, row.drone, row.value, row.partner, row.other,
                    row.extra);
}

TEST(TraceEvent, EachKindHasItsRow) {
  std::set<std::size_t> kinds;
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.row.type);
    kinds.insert(example.kind.index());
    EXPECT_EQ(columns(to_row({3, example.kind})), columns(example.row));
    const TraceEvent read = from_row(example.row, "run.h5");
    EXPECT_EQ(read.kind.index(), example.kind.index());
    EXPECT_EQ(columns(to_row(read)), columns(example.row));
    EXPECT_EQ(to_string(example.kind), example.row.type);
    EXPECT_EQ(drone_of_event(example.kind).value_or(-1), example.row.drone);
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<EventKind>) << "an example of each";
}

TEST(TraceEvent, RowsThatCannotBeAreRefused) {
  const std::vector<std::pair<EventRow, std::string>> damaged = {
      {{0, "explosion"}, "events/type"},
      {{0, ""}, "events/type"},
      {{0, "landed", -1, -1, 0}, "events/drone"},
      {{0, "agent_escaped", -1, -1, 0}, "events/agent"},
      {{0, "agent_escaped", 3, -1, 0.5}, "events/value"},
      {{0, "exit_shut", -1, -1, std::nan("")}, "events/value"},
      {{0, "exit_shut", -1, -1, 1e300}, "events/value"},
      {{0, "collision", -1, 0, 1, "wall", 2, 1}, "events/partner"},
      {{0, "collision", -1, 0, 1, "person", 2, 1}, "events/agent"},
      {{0, "fall", 3, -1, 1, "", -1, 1}, "events/partner"},
      {{0, "falling", -1, 0, 1, "", -1, 2.5}, "events/extra"}};
  for (const auto& [row, column] : damaged) {
    SCOPED_TRACE(row.type);
    try {
      from_row(row, "run.h5");
      ADD_FAILURE() << "is accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("run.h5"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(column), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace throng::world
