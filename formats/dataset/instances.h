// The values of the images of instances (docs/formats.md).
#pragma once

#include <cstdint>

namespace throng::formats {

inline constexpr std::uint32_t kFirstUmbrella = 0x400000;  ///< below it: people, and 0 for nothing
inline constexpr std::uint32_t kFirstBuilding = 0x800000;
inline constexpr std::uint32_t kFirstProp = 0xC00000;
inline constexpr std::uint32_t kFirstDrone = 0xE00000;
inline constexpr std::uint32_t kGround = 0xFF0000;

inline constexpr bool is_person(std::uint32_t id) { return id > 0 && id < kFirstUmbrella; }

}  // namespace throng::formats
