// Instance numbers of a dataset: the ids of the id buffer, packed into 24 bits.
#pragma once

#include <cstdint>

#include "base/error.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// The value in instances/*.png for an id of the id buffer (docs/formats_pixels.md).
inline std::uint32_t instance_of_id(std::uint32_t id) {
  constexpr std::uint32_t kLow16 = 0xFFFFU;
  if (id >= render::kIdBuilding) return (id >> 24U << 16U) | (id & kLow16);
  check((id & ~render::kIdUmbrella) >> 22U == 0, "agents have less than 22 bits");
  return render::is_umbrella(id) ? (id & ~render::kIdUmbrella) | 0x400000U : id;
}

}  // namespace throng::annotate
