// Images of a contact sheet: cameras, people and their poses.
#pragma once

#include <string>
#include <vector>

#include "annotate/people_sheet/sheet_options.h"
#include "camera/camera.h"
#include "render/renderer.h"
#include "skinning/population.h"

namespace throng::annotate {

/// One image to render.
struct SheetShot {
  std::string label;
  camera::Camera camera;
  std::vector<render::PersonInstance> people;
};

/// Images side by side, together at most as wide as the sheet.
struct SheetRow {
  std::string title;  ///< "" for the continuation of the row above
  std::vector<SheetShot> shots;
};

/// Portraits from the front and the side.
std::vector<SheetRow> portrait_rows(const skinning::Population& population,
                                    const SheetOptions& options);

/// A crowd seen by drones at heights of 15, 30 and 50 m that look down by 45 degrees.
SheetRow drone_row(const skinning::Population& population, const SheetOptions& options);

/// The first character of the portraits at eight phases of each gait, then in other poses.
std::vector<SheetRow> motion_rows(const skinning::Population& population,
                                  const SheetOptions& options);

/// Characters of the portraits on the spot, one for each act and each posture of sitting.
std::vector<SheetRow> act_rows(const skinning::Population& population, const SheetOptions& options);

/// Characters of the portraits with each level of detail as a character of its own, in this order:
/// level 0 of the first person, level 1, ..., level 0 of the second, ...
struct LevelsApart {
  skinning::Population population;
  std::vector<std::string> labels;  ///< per character
};
/// The levels of as many characters as fill a row.
LevelsApart levels_apart(const skinning::Population& population, const SheetOptions& options);

/// All these levels, walking.
std::vector<SheetRow> level_rows(const LevelsApart& apart, const SheetOptions& options);

}  // namespace throng::annotate
