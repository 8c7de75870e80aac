// Events of a run. Each kind is a type with fields of its own; a trace file stores them as rows of
// one table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace throng::world {

/// Objects that a drone can collide with or come near to.
enum class Partner : std::uint8_t { ground, building, drone, person };

/// "ground", "building", "drone" or "person".
std::string_view to_string(Partner partner);

/// A person is outside of the scenario's `inside` for the first time.
struct AgentEscaped {
  std::int32_t agent = 0;
  std::int32_t exit = -1;  ///< the one intended; -1: none
};

/// A disaster has reached a door: from now on nobody is led there.
struct ExitClosed {
  std::int32_t exit = 0;
};

/// A drone has wanted more tilt than it may for 3 s on end: it cannot hold its position.
struct TiltSaturated {
  std::int32_t drone = 0;
  double off_m = 0;  ///< distance from its set-point
};

/// A drone is 5 m from its set-point and has moved away from there for 3 s.
struct BlownAway {
  std::int32_t drone = 0;
  double off_m = 0;
};

/// A drone lands, its battery being low.
struct BatteryLow {
  std::int32_t drone = 0;
  double charge = 0;  ///< 0 to 1
};

/// A drone has landed and stops its rotors.
struct Landed {
  std::int32_t drone = 0;
  double height_m = 0;
};

/// A drone's rotors stop, its battery being flat.
struct BatteryFlat {
  std::int32_t drone = 0;
  double height_m = 0;
};

/// A drone hits something.
struct Collision {
  std::int32_t drone = 0;
  Partner partner = Partner::ground;
  std::int32_t index = -1;  ///< of the person, building or drone; -1: the ground
  double speed_mps = 0;     ///< relative, just before
  double impulse_ns = 0;    ///< in the first 50 ms
};

/// A collision was harder than the airframe's propeller limit.
struct PropellerBroken {
  std::int32_t drone = 0;
  double speed_mps = 0;  ///< of the impact on a rigid wall with the same impulse
  std::int32_t rotor = 0;
};

/// A collision was harder than the airframe's structure limit.
struct StructureBroken {
  std::int32_t drone = 0;
  double speed_mps = 0;  ///< as in PropellerBroken
};

/// A drone that cannot hold itself in the air any more begins to fall.
struct Falling {
  std::int32_t drone = 0;
  double height_m = 0;
  int people_near = 0;  ///< within one height of it, measured on the ground
};

/// A person is near to where a free fall would end.
struct FallHazard {
  std::int32_t drone = 0;
  std::int32_t agent = 0;
  double distance_m = 0;
  double in_s = 0;  ///< until then
};

/// A drone came too near to something without hitting it.
struct NearMiss {
  std::int32_t drone = 0;
  Partner partner = Partner::ground;
  std::int32_t index = -1;          ///< as in Collision
  double distance_m = 0;            ///< least, between the surfaces
  std::optional<double> contact_s;  ///< least time to contact; none: never on such a course
};

/// A person falls, struck by a drone or pressed by the crowd.
struct PersonFall {
  std::int32_t agent = 0;
  bool struck = false;
  double impulse_ns = 0;     ///< of the blow
  double crush_n_per_m = 0;  ///< force of the crowd per meter of girth
};

/// A person stood in fast air below a drone.
struct Downwash {
  std::int32_t drone = 0;
  std::int32_t agent = 0;
  double duration_s = 0;
  double max_speed_mps = 0;
};

using EventKind = std::variant<AgentEscaped, ExitClosed, TiltSaturated, BlownAway, BatteryLow,
                               Landed, BatteryFlat, Collision, PropellerBroken, StructureBroken,
                               Falling, FallHazard, NearMiss, PersonFall, Downwash>;

struct TraceEvent {
  double time_s = 0;
  EventKind kind;
};

/// An event as the file has it (docs/trace.md).
struct EventRow {
  double time_s = 0;
  std::string type;          ///< at most 31 characters
  std::int32_t agent = -1;   ///< -1: none
  std::int32_t drone = -1;   ///< -1: none
  double value = 0;          ///< meaning depends on the type
  std::string partner = {};  ///< at most 31 characters; "": none
  std::int32_t other = -1;   ///< number of the partner among its kind (drone, building); -1: none
  double extra = 0;          ///< a second value, whose meaning depends on the type
};

EventRow to_row(const TraceEvent& event);

/// Throws InputError, with `source` as the file's name, for a type or partner that does not exist
/// and for a value that the type cannot have.
TraceEvent from_row(const EventRow& row, const std::string& source);

/// The type's name in the file, such as "collision".
std::string_view to_string(const EventKind& kind);

/// The drone that the event is about.
std::optional<std::int32_t> drone_of_event(const EventKind& kind);

}  // namespace throng::world
