// Events of a run. Each kind of event is a type; a trace file stores all of them as rows of one
// table (docs/trace.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace throng::world {

/// Kinds of objects with which a drone can collide.
enum class Partner : std::uint8_t { ground, building, drone, person };

/// Returns "ground", "building", "drone" or "person".
std::string_view to_string(Partner partner);

/// A person has left Scenario::inside for the first time.
struct AgentEscaped {
  std::int32_t agent = 0;
  std::int32_t exit = -1;  ///< index of the exit that the person intended; -1: none
};

/// A disaster has reached an exit: from now on no drone leads people there.
struct ExitClosed {
  std::int32_t exit = 0;
};

/// A drone has demanded more than its tilt limit for 3 s: it cannot hold its position.
struct TiltSaturated {
  std::int32_t drone = 0;
  double off_m = 0;  ///< distance from its set-point
};

/// A drone is more than 5 m from its set-point and has moved away from it for 3 s.
struct BlownAway {
  std::int32_t drone = 0;
  double off_m = 0;
};

/// A drone starts to land because its battery is low.
struct BatteryLow {
  std::int32_t drone = 0;
  double charge = 0;  ///< state of charge, 0 to 1
};

/// A drone has landed and stops its rotors.
struct Landed {
  std::int32_t drone = 0;
  double height_m = 0;
};

/// A drone's rotors stop because its battery is empty.
struct BatteryFlat {
  std::int32_t drone = 0;
  /// Height above the ground at which the rotors stop.
  double height_m = 0;
};

/// A drone collides.
struct Collision {
  std::int32_t drone = 0;
  Partner partner = Partner::ground;
  std::int32_t index = -1;  ///< index of the person, building or drone; -1: the ground
  double speed_mps = 0;     ///< relative speed before the contact
  double impulse_ns = 0;    ///< impulse of the first 50 ms (N s)
};

/// A collision exceeded the propeller limit of the airframe.
struct PropellerBroken {
  std::int32_t drone = 0;
  double speed_mps = 0;  ///< speed of the impact on a rigid wall that has the same impulse
  std::int32_t rotor = 0;
};

/// A collision exceeded the structure limit of the airframe.
struct StructureBroken {
  std::int32_t drone = 0;
  double speed_mps = 0;  ///< as in PropellerBroken
};

/// A drone that can no longer stay in the air begins to fall.
struct Falling {
  std::int32_t drone = 0;
  double height_m = 0;
  int people_near = 0;  ///< number of people within a horizontal distance of `height_m`
};

/// A person is near the point where a drone in free fall would hit the ground.
struct FallHazard {
  std::int32_t drone = 0;
  std::int32_t agent = 0;
  double distance_m = 0;
  double in_s = 0;  ///< time until the impact
};

/// A drone came too close to an object or a person without a collision.
struct NearMiss {
  std::int32_t drone = 0;
  Partner partner = Partner::ground;
  std::int32_t index = -1;          ///< as in Collision
  double distance_m = 0;            ///< min distance between the surfaces
  std::optional<double> contact_s;  ///< min time to contact; none: the courses never met
};

/// A person falls because of a drone's impact or the pressure of the crowd.
struct PersonFall {
  std::int32_t agent = 0;
  bool struck = false;
  double impulse_ns = 0;     ///< impulse of the impact (N s)
  double crush_n_per_m = 0;  ///< crowd force per meter of body circumference
};

/// A person stood in the downwash of a drone.
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

/// An event as a row of the file (docs/trace.md).
struct EventRow {
  double time_s = 0;
  std::string type;          ///< at most 31 characters
  std::int32_t agent = -1;   ///< -1: none
  std::int32_t drone = -1;   ///< -1: none
  double value = 0;          ///< meaning depends on the type
  std::string partner = {};  ///< at most 31 characters; "": none
  std::int32_t other = -1;   ///< index of the partner (drone, building); -1: none
  double extra = 0;          ///< second value; meaning depends on the type
};

EventRow to_row(const TraceEvent& event);

/// Converts a row to an event. Throws InputError, with `source` as the name of the file, for an
/// unknown type or partner and for invalid values.
TraceEvent from_row(const EventRow& row, const std::string& source);

/// Returns the name of the event's type in the file, such as "collision".
std::string_view to_string(const EventKind& kind);

/// Returns the index of the drone that the event concerns, or nothing.
std::optional<std::int32_t> drone_of_event(const EventKind& kind);

}  // namespace throng::world
