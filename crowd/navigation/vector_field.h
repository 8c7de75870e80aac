// Directions on a grid, from a file.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/elements/text_file.h"

namespace throng::crowd {

/// Vectors at the centers of a grid's cells; outside of the grid, the nearest cell's.
class VectorField {
 public:
  /// Reads Menge's format: rows and columns, cell size, the corner of least x and y, then the
  /// vectors row by row. Throws InputError (file, line, found, expected), EnvironmentError when
  /// the file cannot be read.
  explicit VectorField(const TextFile& source);

  /// The velocity of the cell that holds the point.
  Eigen::Vector2f nearest(const Eigen::Vector2f& point) const;
  /// Between the four cells around the point.
  Eigen::Vector2f interpolated(const Eigen::Vector2f& point) const;

 private:
  const Eigen::Vector2f& at(int row, int column) const;
  Eigen::Vector2f cell_of(const Eigen::Vector2f& point) const {
    return (point - min_) / cell_size_m_;
  }

  int rows_ = 0;
  int columns_ = 0;
  float cell_size_m_ = 1;
  Eigen::Vector2f min_;
  std::vector<Eigen::Vector2f> vectors_;  // row by row
};

}  // namespace throng::crowd
