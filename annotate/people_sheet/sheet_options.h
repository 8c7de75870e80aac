// Content and size of the contact sheet of a character library.
#pragma once

#include <cstdint>
#include <vector>

#include "render/renderer.h"

namespace throng::annotate {

/// Content and size of a sheet.
struct SheetOptions {
  std::vector<std::uint32_t> portraits;  ///< characters of the portraits; at least one
  std::vector<std::uint32_t> crowd;      ///< characters of the drones' views; at least one
  std::uint64_t seed = 1;                ///< of colors, the crowd and the heights
  int width_px = 2400;                   ///< width of the sheet, 800 to 8000
  render::DeviceChoice device;
};

}  // namespace throng::annotate
