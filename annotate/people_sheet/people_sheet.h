// A sheet of a population, for people to judge it by: everybody from the front and from the side,
// a crowd as drones see it, gaits, levels of detail, and how tall people are. All people
// are rendered by the renderer of datasets.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "render/renderer.h"
#include "skinning/population.h"

namespace throng::annotate {

struct SheetOptions {
  std::vector<std::uint32_t> portraits;  ///< characters; at least one
  std::vector<std::uint32_t> crowd;      ///< characters of the drones' views; at least one
  std::uint64_t seed = 1;                ///< of colors, of the crowd and of the heights
  int width_px = 2400;                   ///< of the sheet, 800 to 8000
  render::DeviceChoice device;
};

/// One drawn image of the sheet.
struct SheetCell {
  std::string label;
  int x = 0;  ///< of its upper left corner
  int y = 0;
  int width = 0;
  int height = 0;
  std::uint64_t person_px = 0;  ///< pixels that show somebody
};

struct Sheet {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< rows top-down, sRGB
  std::vector<SheetCell> cells;
};

/// Called between images with the share that is done; may throw to end the work.
using SheetProgress = std::function<void(double share, std::string_view what)>;

/// Throws EnvironmentError when this machine cannot render.
Sheet draw_people_sheet(const skinning::Population& population, const SheetOptions& options,
                        const SheetProgress& progress = {});

}  // namespace throng::annotate
