// The images of a people's sheet: cameras, people before them and their poses.
#pragma once

#include <string>
#include <vector>

#include "annotate/people_sheet/people_sheet.h"
#include "camera/camera.h"
#include "render/renderer.h"
#include "skinning/population.h"

namespace throng::annotate {

struct SheetShot {
  std::string label;
  camera::Camera camera;
  std::vector<render::PersonInstance> people;
};

/// Images side by side, as wide together as the sheet, or less.
struct SheetRow {
  std::string title;  ///< empty where the row above goes on
  std::vector<SheetShot> shots;
};

/// Everybody from the front and from the side.
std::vector<SheetRow> portrait_rows(const skinning::Population& population,
                                    const SheetOptions& options);

/// A crowd as drones see it that fly 15, 30 and 50 m high and look down by 45 degrees.
SheetRow drone_row(const skinning::Population& population, const SheetOptions& options);

/// The first of the portraits' people in eight moments of each gait, then in other
/// poses.
std::vector<SheetRow> motion_rows(const skinning::Population& population,
                                  const SheetOptions& options);

/// As many of the portraits' people as fill a row, each level of detail as a character of its own,
/// in order: level 0 of the first person, level 1, ..., level 0 of the second, ...
struct LevelsApart {
  skinning::Population population;
  std::vector<std::string> labels;
};
LevelsApart levels_apart(const skinning::Population& population, const SheetOptions& options);

/// All those levels, walking.
std::vector<SheetRow> level_rows(const LevelsApart& apart, const SheetOptions& options);

}  // namespace throng::annotate
