// Binary records in the messages of a live flight (live/messages.h, docs/studio.md).
#pragma once

#include <array>
#include <cstdint>

#include "spec/layouts/binary_field.h"

namespace throng::layouts {

/// Version of the messages: it increases with each change that older clients would misread.
inline constexpr std::uint8_t kLiveVersion = 2;

/// Beginning of a message with the state of a step; its drones and then its people follow.
struct StateHead {
  std::uint8_t version = kLiveVersion;
  std::uint8_t flags = 0;  ///< kIsPaused
  std::uint16_t drones = 0;
  std::uint32_t people = 0;
  double time_s = 0;
  float factor = 0;  ///< simulated seconds per second that are reached
  std::uint32_t sequence = 0;
};
inline constexpr std::uint8_t kIsPaused = 1;
inline constexpr std::array kStateHeadFields = {
    field("version", &StateHead::version),  field("flags", &StateHead::flags),
    field("drones", &StateHead::drones),    field("people", &StateHead::people),
    field("time_s", &StateHead::time_s),    field("factor", &StateHead::factor),
    field("sequence", &StateHead::sequence)};
static_assert(fill(kStateHeadFields, sizeof(StateHead)));

struct DroneRecord {
  std::array<float, 3> position{};    ///< m
  std::array<float, 4> quaternion{};  ///< w, x, y, z; body to world
  float speed_mps = 0;
  std::uint32_t flags = 0;            ///< kHasBeacon, kIsOnMission, kIsRunning
  std::array<float, 2> gimbal_deg{};  ///< pitch above the horizon, yaw to the left of the heading
};
inline constexpr std::uint32_t kHasBeacon = 1;
inline constexpr std::uint32_t kIsOnMission = 2;
inline constexpr std::uint32_t kIsRunning = 4;
inline constexpr std::array kDroneFields = {
    field("position", &DroneRecord::position), field("quaternion", &DroneRecord::quaternion),
    field("speed_mps", &DroneRecord::speed_mps), field("flags", &DroneRecord::flags),
    field("gimbal_deg", &DroneRecord::gimbal_deg)};
static_assert(fill(kDroneFields, sizeof(DroneRecord)));

struct PersonRecord {
  std::array<float, 2> position{};  ///< m
  std::int16_t yaw = 0;             ///< in 1 / kYawParts rad
  std::uint8_t state = 0;           ///< index in the names of the hello
  std::uint8_t flags = 0;           ///< world::kPresent and the like
};
inline constexpr int kYawParts = 10'000;
inline constexpr std::array kPersonFields = {
    field("position", &PersonRecord::position), field("yaw", &PersonRecord::yaw),
    field("state", &PersonRecord::state), field("flags", &PersonRecord::flags)};
static_assert(fill(kPersonFields, sizeof(PersonRecord)));

/// Beginning of a message with a camera's image; a JPEG file follows.
struct ImageHead {
  double time_s = 0;
  std::uint32_t sequence = 0;
  std::uint32_t drone = 0;
};
inline constexpr std::array kImageHeadFields = {field("time_s", &ImageHead::time_s),
                                                field("sequence", &ImageHead::sequence),
                                                field("drone", &ImageHead::drone)};
static_assert(fill(kImageHeadFields, sizeof(ImageHead)));

}  // namespace throng::layouts
