// Fields on the ground on grids with cells of other sizes.
#pragma once

#include <string>

#include "annotate/rasters/ground_field.h"

namespace throng::annotate {

/// A grid with the corner of a GroundGrid and cells of any size, as many as cover its ground.
struct FieldLevel {
  double cell_m = 1;
  int columns = 1;
  int rows = 1;
};
FieldLevel field_level(const GroundGrid& grid, double cell_m);

/// The field on the level's grid: what each cell of `grid` holds is shared out among the level's
/// cells by the areas that they have in common. So densities times the area of a cell sum to
/// `people`; velocities are the means of the people in a cell.
GroundField field_on(const FieldLevel& level, const GroundGrid& grid, const GroundField& field);

/// The bytes of a .npy file, like those of a GroundGrid's field.
std::string npy_bytes(const FieldLevel& level, const GroundField& field);

/// The folder below fields/RUN/ of the fields with such cells: "cell_2", "cell_0.5".
std::string level_folder(double cell_m);

}  // namespace throng::annotate
