#include "annotate/rasters/field_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "annotate/rasters/density.h"

namespace throng::annotate {

namespace {

/// A cell of one axis of the level, and the part (m) of a grid's cell that lies in it.
struct Overlap {
  int cell = 0;
  double length_m = 0;
};

/// For each of `count` cells of `fine_m` the cells of `coarse_m` that it reaches into. The part
/// beyond the level's last cell, by rounding, counts for that.
std::vector<std::vector<Overlap>> overlaps(int count, double fine_m, int coarse_count,
                                           double coarse_m) {
  constexpr double kRoundingM = 1e-9;
  std::vector<std::vector<Overlap>> found(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double from = i * fine_m;
    const double to = from + fine_m;
    const int first = std::min(static_cast<int>(std::floor(from / coarse_m)), coarse_count - 1);
    const int last = std::min(static_cast<int>(std::floor(to / coarse_m)), coarse_count - 1);
    for (int cell = first; cell <= last; ++cell) {
      const double until = cell == coarse_count - 1 ? to : std::min(to, (cell + 1) * coarse_m);
      const double length = until - std::max(from, cell * coarse_m);
      if (length > kRoundingM) found[static_cast<std::size_t>(i)].push_back({cell, length});
    }
  }
  return found;
}

}  // namespace

FieldLevel field_level(const GroundGrid& grid, double cell_m) {
  const auto count = [&](int cells) {
    return std::max(1, static_cast<int>(std::ceil(cells * grid.cell_m() / cell_m - 1e-9)));
  };
  return {cell_m, count(grid.columns()), count(grid.rows())};
}

GroundField field_on(const FieldLevel& level, const GroundGrid& grid, const GroundField& field) {
  const std::size_t cells =
      static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows);
  std::vector<double> people(cells);
  std::vector<double> x(cells);
  std::vector<double> y(cells);
  std::vector<double> voronoi(cells);
  const auto columns = overlaps(grid.columns(), grid.cell_m(), level.columns, level.cell_m);
  const auto rows = overlaps(grid.rows(), grid.cell_m(), level.rows, level.cell_m);
  std::size_t from = 0;
  for (const std::vector<Overlap>& row : rows) {
    for (const std::vector<Overlap>& column : columns) {
      for (const Overlap& above : row) {
        for (const Overlap& beside : column) {
          const double area_m2 = above.length_m * beside.length_m;
          const std::size_t to =
              static_cast<std::size_t>(above.cell) * static_cast<std::size_t>(level.columns) +
              static_cast<std::size_t>(beside.cell);
          const double here = area_m2 * static_cast<double>(field.density[from]);
          people[to] += here;
          x[to] += here * static_cast<double>(field.velocity_x[from]);
          y[to] += here * static_cast<double>(field.velocity_y[from]);
          voronoi[to] += area_m2 * static_cast<double>(field.voronoi[from]);
        }
      }
      ++from;
    }
  }
  GroundField found;
  found.people = field.people;
  const double cell_m2 = level.cell_m * level.cell_m;
  for (std::size_t i = 0; i < cells; ++i) {
    const double mean = people[i] > 0 ? 1 / people[i] : 0;
    found.density.push_back(static_cast<float>(people[i] / cell_m2));
    found.velocity_x.push_back(static_cast<float>(x[i] * mean));
    found.velocity_y.push_back(static_cast<float>(y[i] * mean));
    found.voronoi.push_back(static_cast<float>(voronoi[i] / cell_m2));
  }
  return found;
}

std::string npy_bytes(const FieldLevel& level, const GroundField& field) {
  std::vector<float> values = field.density;
  for (const auto* plane : {&field.velocity_x, &field.velocity_y, &field.voronoi}) {
    values.insert(values.end(), plane->begin(), plane->end());
  }
  return npy_bytes(std::array{4, level.rows, level.columns}, values);
}

std::string level_folder(double cell_m) { return fmt::format("cell_{}", cell_m); }

}  // namespace throng::annotate
