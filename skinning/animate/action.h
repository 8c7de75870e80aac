// Actions of people that are visible in their motion.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace throng::skinning {

enum class Action : std::uint8_t {
  stand,
  walk,
  run,
  turn,  ///< turns on the spot
  fall,
  lie,
  get_up,
  look_around,
  use_phone,      ///< looks at a phone in the hand
  look_at_drone,  ///< looks up at a drone
  panic,          ///< runs with raised arms
  sit,
  cheer,  ///< stands with raised arms, which wave
  squat,
  cower,  ///< crouches with the hands over the head
  lean,   ///< against a wall, a rail or a table
  talk,   ///< with gestures
  call,   ///< holds a phone to the ear
  film,   ///< holds a phone up before the eyes
  point,
  wave,
  clap,
  dance,
  eat,
  drink,
  smoke,
  read,       ///< a map or a leaflet, held with both hands
  look_back,  ///< turns the head over the shoulder while moving
};
inline constexpr std::size_t kActionCount = 28;
inline constexpr std::array<std::string_view, kActionCount> kActionNames = {
    "stand",       "walk",      "run",           "turn",  "fall",  "lie",   "get_up",
    "look_around", "use_phone", "look_at_drone", "panic", "sit",   "cheer", "squat",
    "cower",       "lean",      "talk",          "call",  "film",  "point", "wave",
    "clap",        "dance",     "eat",           "drink", "smoke", "read",  "look_back"};

/// A set of simultaneous actions: one of stand to get_up, sit, squat and cower, and any of the
/// others.
class Actions {
 public:
  constexpr Actions() = default;
  template <typename... Each>
  constexpr explicit Actions(Each... each) : bits_((0U | ... | bit(each))) {}

  constexpr bool has(Action action) const { return (bits_ & bit(action)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool operator==(const Actions&) const = default;

 private:
  static constexpr std::uint32_t bit(Action action) {
    return std::uint32_t{1} << static_cast<unsigned>(action);
  }

  std::uint32_t bits_ = 0;
};

}  // namespace throng::skinning
