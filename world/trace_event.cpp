#include "world/trace_event.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace throng::world {

namespace {

constexpr std::array<std::string_view, 4> kPartners = {"ground", "building", "drone", "person"};

/// In the order of EventKind.
constexpr std::array<std::string_view, std::variant_size_v<EventKind>> kNames = {
    "agent_escaped",    "exit_shut",   "tilt_saturated",
    "blown_away",       "battery_low", "landed",
    "battery_flat",     "collision",   "propeller_broken",
    "structure_broken", "falling",     "fall_hazard",
    "near_miss",        "fall",        "downwash"};

constexpr double kNever = -1;

// to_row(): each writes its own columns.
void write(const AgentEscaped& event, EventRow& row) {
  row.agent = event.agent;
  row.value = event.exit;
}
void write(const ExitClosed& event, EventRow& row) { row.value = event.exit; }
void write(const TiltSaturated& event, EventRow& row) { row.value = event.off_m; }
void write(const BlownAway& event, EventRow& row) { row.value = event.off_m; }
void write(const BatteryLow& event, EventRow& row) { row.value = event.charge; }
void write(const Landed& event, EventRow& row) { row.value = event.height_m; }
void write(const BatteryFlat& event, EventRow& row) { row.value = event.height_m; }
void write_partner(Partner partner, std::int32_t index, EventRow& row) {
  row.partner = to_string(partner);
  (partner == Partner::person ? row.agent : row.other) = index;
}
void write(const Collision& event, EventRow& row) {
  write_partner(event.partner, event.index, row);
  row.value = event.speed_mps;
  row.extra = event.impulse_ns;
}
void write(const PropellerBroken& event, EventRow& row) {
  row.value = event.speed_mps;
  row.extra = event.rotor;
}
void write(const StructureBroken& event, EventRow& row) { row.value = event.speed_mps; }
void write(const Falling& event, EventRow& row) {
  row.value = event.height_m;
  row.extra = event.people_near;
}
void write(const FallHazard& event, EventRow& row) {
  row.agent = event.agent;
  row.value = event.distance_m;
  row.extra = event.in_s;
}
void write(const NearMiss& event, EventRow& row) {
  write_partner(event.partner, event.index, row);
  row.value = event.distance_m;
  row.extra = event.contact_s.value_or(kNever);
}
void write(const PersonFall& event, EventRow& row) {
  row.agent = event.agent;
  row.value = event.impulse_ns;
  row.partner = event.struck ? "drone" : "crowd";
  row.extra = event.crush_n_per_m;
}
void write(const Downwash& event, EventRow& row) {
  row.agent = event.agent;
  row.value = event.duration_s;
  row.extra = event.max_speed_mps;
}

/// A row of a file, whose columns are checked as they are read.
class RowReader {
 public:
  RowReader(const EventRow& row, const std::string& source) : row_(row), source_(source) {}

  std::int32_t drone() const { return present(row_.drone, "drone"); }
  std::int32_t agent() const { return present(row_.agent, "agent"); }
  std::int32_t integer(double value, const char* column) const {
    constexpr double kMax = std::numeric_limits<std::int32_t>::max();
    if (value == std::trunc(value) && std::abs(value) <= kMax) {
      return static_cast<std::int32_t>(value);
    }
    reject(column, fmt::format("{}", value), fmt::format("an integer for \"{}\"", row_.type));
  }
  Partner partner() const {
    const auto found = std::find(kPartners.begin(), kPartners.end(), row_.partner);
    if (found != kPartners.end()) return static_cast<Partner>(found - kPartners.begin());
    reject("partner", fmt::format("\"{}\"", row_.partner),
           "\"ground\", \"building\", \"drone\" or \"person\"");
  }
  std::int32_t index(Partner partner) const {
    return partner == Partner::person ? agent() : row_.other;
  }
  bool struck() const {
    if (row_.partner == "drone" || row_.partner == "crowd") return row_.partner == "drone";
    reject("partner", fmt::format("\"{}\"", row_.partner), "\"drone\" or \"crowd\"");
  }

  [[noreturn]] void reject(const char* column, std::string found, std::string expected) const {
    throw InputError(
        {source_, fmt::format("events/{}", column), std::move(found), std::move(expected)});
  }

 private:
  std::int32_t present(std::int32_t number, const char* column) const {
    if (number >= 0) return number;
    reject(column, fmt::format("{}", number), fmt::format("a number for \"{}\"", row_.type));
  }

  const EventRow& row_;
  const std::string& source_;
};

using Read = EventKind (*)(const EventRow& row, const RowReader& reader);

/// In the order of EventKind.
constexpr std::array<Read, std::variant_size_v<EventKind>> kReaders = {
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return AgentEscaped{read.agent(), read.integer(row.value, "value")};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return ExitClosed{read.integer(row.value, "value")};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return TiltSaturated{read.drone(), row.value};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return BlownAway{read.drone(), row.value};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return BatteryLow{read.drone(), row.value};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return Landed{read.drone(), row.value};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return BatteryFlat{read.drone(), row.value};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      const Partner partner = read.partner();
      return Collision{read.drone(), partner, read.index(partner), row.value, row.extra};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return PropellerBroken{read.drone(), row.value, read.integer(row.extra, "extra")};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return StructureBroken{read.drone(), row.value};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return Falling{read.drone(), row.value, read.integer(row.extra, "extra")};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return FallHazard{read.drone(), read.agent(), row.value, row.extra};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      const Partner partner = read.partner();
      const auto contact_s = row.extra < 0 ? std::nullopt : std::optional(row.extra);
      return NearMiss{read.drone(), partner, read.index(partner), row.value, contact_s};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return PersonFall{read.agent(), read.struck(), row.value, row.extra};
    },
    [](const EventRow& row, const RowReader& read) -> EventKind {
      return Downwash{read.drone(), read.agent(), row.value, row.extra};
    }};

}  // namespace

std::string_view to_string(Partner partner) { return kPartners[static_cast<std::size_t>(partner)]; }

std::string_view to_string(const EventKind& kind) { return kNames[kind.index()]; }

std::optional<std::int32_t> drone_of_event(const EventKind& kind) {
  return std::visit(
      [](const auto& event) -> std::optional<std::int32_t> {
        if constexpr (requires { event.drone; }) return event.drone;
        return std::nullopt;
      },
      kind);
}

EventRow to_row(const TraceEvent& event) {
  EventRow row;
  row.time_s = event.time_s;
  row.type = to_string(event.kind);
  row.drone = drone_of_event(event.kind).value_or(-1);
  std::visit([&](const auto& kind) { write(kind, row); }, event.kind);
  return row;
}

TraceEvent from_row(const EventRow& row, const std::string& source) {
  const RowReader reader(row, source);
  const auto found = std::find(kNames.begin(), kNames.end(), row.type);
  if (found == kNames.end()) {
    reader.reject("type", fmt::format("\"{}\"", row.type), "an event of docs/trace.md");
  }
  return {row.time_s, kReaders[static_cast<std::size_t>(found - kNames.begin())](row, reader)};
}

}  // namespace throng::world
