// Contact sheet of a character library, for visual inspection: portraits from the front and the
// side, a crowd as drones see it, gaits, levels of detail, and the distribution of heights. It uses
// the same renderer as datasets.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/people_sheet/sheet_options.h"
#include "render/renderer.h"
#include "skinning/population.h"

namespace throng::annotate {

/// One image of the sheet.
struct SheetCell {
  std::string label;
  int x = 0;  ///< upper left corner in the sheet, px
  int y = 0;
  int width = 0;
  int height = 0;
  std::uint64_t person_px = 0;  ///< number of pixels that show a person
};

/// The rendered sheet.
struct Sheet {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< sRGB, three bytes per pixel, row by row from the top
  std::vector<SheetCell> cells;
};

/// Called between images with the finished share, 0 to 1, and the name of the next step; may throw
/// to cancel the work.
using SheetProgress = std::function<void(double share, std::string_view what)>;

/// Renders the sheet. Throws EnvironmentError if this machine cannot render.
Sheet draw_people_sheet(const skinning::Population& population, const SheetOptions& options,
                        const SheetProgress& progress = {});

}  // namespace throng::annotate
