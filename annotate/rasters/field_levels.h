// Ground fields resampled to grids with other cell sizes.
#pragma once

#include <string>

#include "annotate/rasters/ground_field.h"

namespace throng::annotate {

/// A grid with the origin of a GroundGrid and another cell size.
struct FieldLevel {
  double cell_m = 1;
  int columns = 1;
  int rows = 1;
};
/// The level with as many cells of this size as cover the grid.
FieldLevel field_level(const GroundGrid& grid, double cell_m);

/// Resamples a field from `grid` to the level: the people of each cell are distributed to the
/// level's cells in proportion to the areas of overlap, so that densities times the area of a cell
/// still sum to `people`. Velocities are means over the people in a cell.
GroundField field_on(const FieldLevel& level, const GroundGrid& grid, const GroundField& field);

/// The bytes of a .npy file, float32, C order, shape (4, rows, columns): density, velocity x, y,
/// Voronoi density.
std::string npy_bytes(const FieldLevel& level, const GroundField& field);

/// Name of the folder below fields/RUN/ for this cell size: "cell_2", "cell_0.5".
std::string level_folder(double cell_m);

}  // namespace throng::annotate
